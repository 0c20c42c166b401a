// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vantage/evaluation/run_figures.hpp>
#include <vantage/evaluation/spread.hpp>
#include <vantage/report/report_html.hpp>

#include <vantage/map/impl/file_bytes.hpp>
#include "apps/report_commands.hpp"
#include "apps/run_files.hpp"

namespace vantage::apps {
namespace {

constexpr std::size_t kMostReportBytes = std::size_t{1} << 28U;

struct CompareRequest {
  std::vector<std::string> reports;
  std::string out;
  bool by_folder = false;
};

// What the table shows of a run.
struct ComparedRun {
  RunFigures figures;
  std::string group = {};  // planner and world, or the folder
};

ComparedRun compared(const std::string& file, const std::string& text) {
  try {
    ComparedRun run{.figures = run_figures(text)};
    std::ostringstream group;
    group << run.figures.planner << " in " << std::filesystem::path(run.figures.world).stem().string() << ", "
          << run.figures.resolution_m << " m";
    run.group = group.str();
    return run;
  } catch (const std::invalid_argument&) {
    throw std::runtime_error(file + ": is no report.json of a run");
  }
}

// Median and quartiles of a figure; what a run lacks is left out.
std::string spread_of(const std::vector<const ComparedRun*>& runs, int digits,
                      const std::function<std::optional<double>(const RunFigures&)>& figure) {
  std::vector<double> values;
  for (const ComparedRun* run : runs) {
    if (const std::optional<double> value = figure(run->figures)) {
      values.push_back(*value);
    }
  }
  return spread_text(values, digits);
}

void print_table(const std::vector<ComparedRun>& runs, std::ostream& out) {
  std::map<std::string, std::vector<const ComparedRun*>> groups;
  for (const ComparedRun& run : runs) {
    groups[run.group].push_back(&run);
  }
  std::vector<std::vector<std::string>> rows{
      {"planner", "runs", "views", "path, m", "turned, deg", "time, s", "coverage, %", "computing, s", "plan, ms"}};
  for (const auto& group : groups) {
    const std::vector<const ComparedRun*>& members = group.second;
    const auto add = [&](int digits, const std::function<std::optional<double>(const RunFigures&)>& figure) {
      rows.back().push_back(spread_of(members, digits, figure));
    };
    rows.push_back({group.first, std::to_string(members.size())});
    add(0, [](const RunFigures& run) { return static_cast<double>(run.views); });
    add(1, [](const RunFigures& run) { return run.path_m; });
    add(0, [](const RunFigures& run) { return run.turned_deg; });
    add(1, [](const RunFigures& run) { return run.duration_s; });
    add(2, [](const RunFigures& run) { return run.covered ? std::optional(100.0 * *run.covered) : std::nullopt; });
    add(1, [](const RunFigures& run) { return run.computing_s; });
    add(1, [](const RunFigures& run) {
      return run.plan_ms.empty() ? std::nullopt : std::optional(quantile(run.plan_ms, 0.5));
    });
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

void compare(const CompareRequest& request) {
  check_targets(request.out, "");
  std::vector<ComparedRun> runs;
  std::vector<ReportedRun> reported;
  for (const std::string& file : request.reports) {
    const std::filesystem::path record = std::filesystem::path(file).parent_path() / "run.record";
    reported.push_back({detail::file_bytes(file, kMostReportBytes),
                        std::filesystem::exists(record) ? record : std::filesystem::path()});
    runs.push_back(compared(file, reported.back().report));
    if (request.by_folder) {
      runs.back().group = std::filesystem::absolute(file).parent_path().filename().string();
    }
  }
  const std::filesystem::path folder = request.out;
  make_folder(folder);
  write_report_html(reported, folder / "report.html");
  print_table(runs, std::cout);
  tell_files(std::cout, {folder / "report.html"});
}

}  // namespace

void add_compare_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Lay the reports of several runs side by side");
  const auto request = std::make_shared<CompareRequest>();
  command->add_option("REPORT.json", request->reports, "Reports of runs; a run.record beside one is replayed")
      ->required()
      ->type_name("REPORT.json...");
  command->add_option("--out", request->out, "Folder for report.html; required")->required()->type_name("DIR");
  command->add_flag("--by-folder", request->by_folder,
                    "Call runs by their folders: where settings differ, not planner, world and seed");
  command->footer(
      "Examples:\n"
      "  vantage compare harmonic/report.json gain/report.json --out both\n"
      "  vantage compare seed*/report.json --out seeds");
  command->callback([request] { compare(*request); });
}

}  // namespace vantage::apps
