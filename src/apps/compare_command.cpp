// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <vantage/report/report_html.hpp>
#include <vantage/vision/line_plot.hpp>
#include <vantage/vision/picture.hpp>

#include "apps/report_commands.hpp"
#include "apps/run_files.hpp"

namespace vantage::apps {
namespace {

struct CompareRequest {
  std::vector<std::string> reports;
  std::string out;
  bool by_folder = false;
};

// What the table shows of a run.
struct ComparedRun {
  std::string group;  // planner and world
  std::string name;   // the same with the seed
  nlohmann::json report;
  double views = 0.0;
  double path_m = 0.0;
  double share = std::nan("");  // seen coverage if there is one, else coverage
  double seconds = 0.0;         // of computing
  double plan_ms = std::nan("");
  std::vector<double> curve;  // the share after each view
};

double number_or_nan(const nlohmann::json& value) { return value.is_number() ? value.get<double>() : std::nan(""); }

// Seen coverage if there is one, else coverage; of a report or of one of its cycles.
double share_in(const nlohmann::json& measured) {
  const auto seen = measured.find("seen_coverage");
  return number_or_nan(seen != measured.end() && !seen->is_null() ? *seen : measured.at("coverage"));
}

ComparedRun compared(const std::string& file, const std::string& text) {
  try {
    ComparedRun run;
    run.report = nlohmann::json::parse(text);
    const nlohmann::json& report = run.report;
    std::ostringstream group;
    group << report.at("planner").get<std::string>() << " in "
          << std::filesystem::path(report.at("world").get<std::string>()).stem().string() << ", "
          << report.at("resolution_m").get<double>() << " m";
    run.group = group.str();
    run.name = run.group + ", seed " + report.at("seed").dump();
    run.views = report.at("views").get<double>();
    run.path_m = report.at("path_length_m").get<double>();
    run.share = share_in(report);
    run.plan_ms = number_or_nan(report.at("time_ms").at("plan").at("median"));
    for (const nlohmann::json& cycle : report.at("cycles")) {
      run.curve.push_back(share_in(cycle));
      run.seconds += (cycle.at("insert_ms").get<double>() + cycle.at("plan_ms").get<double>()) / 1000.0;
    }
    return run;
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error(file + ": is no report.json of a run");
  }
}

std::string read_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) {
    throw std::runtime_error(file + ": cannot be read");
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

double quantile_of(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

// Median, with quartiles if there are several runs.
std::string spread_of(const std::vector<const ComparedRun*>& runs, double ComparedRun::*member, int digits,
                      double unit = 1.0) {
  std::vector<double> values;
  for (const ComparedRun* run : runs) {
    if (!std::isnan(run->*member)) {
      values.push_back(unit * run->*member);
    }
  }
  if (values.empty()) {
    return "-";
  }
  std::sort(values.begin(), values.end());
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << quantile_of(values, 0.5);
  if (values.size() > 1) {
    text << " (" << quantile_of(values, 0.25) << "-" << quantile_of(values, 0.75) << ")";
  }
  return text.str();
}

void print_table(const std::vector<ComparedRun>& runs, std::ostream& out) {
  std::map<std::string, std::vector<const ComparedRun*>> groups;
  for (const ComparedRun& run : runs) {
    groups[run.group].push_back(&run);
  }
  std::vector<std::vector<std::string>> rows{
      {"planner", "runs", "views", "path, m", "coverage, %", "computing, s", "plan, ms"}};
  for (const auto& [group, members] : groups) {
    rows.push_back({group, std::to_string(members.size()), spread_of(members, &ComparedRun::views, 0),
                    spread_of(members, &ComparedRun::path_m, 1), spread_of(members, &ComparedRun::share, 2, 100.0),
                    spread_of(members, &ComparedRun::seconds, 1), spread_of(members, &ComparedRun::plan_ms, 1)});
  }
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      out << (i == 0 ? "" : "  ") << row[i] << std::string(i + 1 < row.size() ? widths[i] - row[i].size() : 0, ' ');
    }
    out << '\n';
  }
  out << "(median, with quartiles where there are several runs)\n";
}

Picture overlaid_coverage(const std::vector<ComparedRun>& runs) {
  LinePlot views{.title = "coverage over views",
                 .x_label = "views (scans integrated)",
                 .y_label = "",
                 .y_range = std::pair(0.0, 100.0),
                 .value_unit = " %"};
  LinePlot metres = views;
  metres.title = "coverage over metres";
  metres.x_label = "path travelled [m]";
  const bool objects = std::all_of(runs.begin(), runs.end(),
                                   [](const ComparedRun& run) { return run.report.at("command") == "reconstruct"; });
  views.y_label = objects ? "surface seen [%]" : "observable cells known rightly [%]";
  metres.y_label = views.y_label;
  for (const ComparedRun& run : runs) {
    LineSeries over_views{.name = run.name};
    LineSeries over_metres{.name = run.name};
    for (const nlohmann::json& cycle : run.report.at("cycles")) {
      over_views.x.push_back(cycle.at("view").get<double>());
      over_metres.x.push_back(cycle.at("path_length_m").get<double>());
    }
    for (const double share : run.curve) {
      over_views.y.push_back(100.0 * share);
    }
    over_metres.y = over_views.y;
    views.series.push_back(std::move(over_views));
    metres.series.push_back(std::move(over_metres));
  }
  return draw_line_plots(std::vector<LinePlot>{std::move(views), std::move(metres)});
}

void compare(const CompareRequest& request) {
  check_targets(request.out, "");
  std::vector<ComparedRun> runs;
  std::vector<ReportedRun> reported;
  for (const std::string& file : request.reports) {
    const std::filesystem::path record = std::filesystem::path(file).parent_path() / "run.record";
    reported.push_back({read_file(file), std::filesystem::exists(record) ? record : std::filesystem::path()});
    runs.push_back(compared(file, reported.back().report));
    if (request.by_folder) {
      runs.back().group = std::filesystem::absolute(file).parent_path().filename().string();
      runs.back().name = runs.back().group;
    }
  }
  const std::filesystem::path folder = request.out;
  make_folder(folder);
  write_report_html(reported, folder / "report.html");
  std::vector<std::filesystem::path> files{folder / "report.html"};
  if (std::any_of(runs.begin(), runs.end(), [](const ComparedRun& run) {
        return std::any_of(run.curve.begin(), run.curve.end(), [](double share) { return !std::isnan(share); });
      })) {
    files.push_back(folder / "coverage.png");
    write_png(overlaid_coverage(runs), files.back());
  }
  print_table(runs, std::cout);
  tell_files(std::cout, files);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Lay the reports of several runs side by side");
  const auto request = std::make_shared<CompareRequest>();
  command->add_option("reports", request->reports, "As runs wrote them; a run.record beside one is replayed")
      ->required()
      ->type_name("REPORT.json...");
  command->add_option("--out", request->out, "Folder for report.html and coverage.png; must be given")
      ->required()
      ->type_name("DIR");
  command->add_flag("--by-folder", request->by_folder,
                    "Call runs by their folders: where settings differ, not planner, world and seed");
  command->footer(
      "Examples:\n"
      "  vantage compare harmonic/report.json gain/report.json --out both\n"
      "  vantage compare seed*/report.json --out seeds");
  command->callback([request] { compare(*request); });
}

}  // namespace vantage::apps
