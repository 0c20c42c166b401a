// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <vantage/report/map_export.hpp>
#include <vantage/report/report_html.hpp>
#include <vantage/report/report_json.hpp>
#include <vantage/report/run_record_reader.hpp>

#include "apps/report_commands.hpp"
#include "apps/run_files.hpp"

namespace vantage::apps {
namespace {

struct ReportRequest {
  std::string record;
  std::string out;
  bool ply = false;
  bool paraview = false;
};

void report(const ReportRequest& request) {
  check_targets(request.out, "");
  RunRecordReader reader(request.record);
  OccupancyMap map = reader.new_map();
  while (const std::optional<RecordedCycle> cycle = reader.next()) {
    apply_changes(*cycle, map);
  }
  const RunRecord& run = reader.run();
  using std::filesystem::path;
  const path folder = request.out;
  make_folder(folder);
  OutputFiles files;
  files.write(folder / "report.json", [&](const path& file) { write_report_json(run, file); });
  files.write(folder / "report.html", [&](const path& file) { write_report_html(request.record, file); });
  std::cout << run.planner << " in " << run.world << ": " << run.views.size() << " views, " << to_string(run.outcome)
            << ": " << run.reason << '\n';
  if (!reader.tail().empty()) {
    std::cout << "What follows the last view could not be used: " << reader.tail() << '\n';
  }
  if (request.ply) {
    files.write(folder / "map.ply", [&](const path& file) { write_ply_mesh(map, file); });
    files.write(folder / "points.ply", [&](const path& file) { write_ply_points(map, file); });
  }
  if (request.paraview) {
    files.attempt([&] {
      for (const path& file : write_paraview(request.record, folder)) {
        files.add(file);
      }
    });
  }
  tell_files(std::cout, files.written());
  files.check();
}

}  // namespace

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("report", "Make the page and the report of a recorded run");
  const auto request = std::make_shared<ReportRequest>();
  command->add_option("RUN.record", request->record, "As a run left it, finished or not")
      ->required()
      ->type_name("RUN.record");
  command->add_option("--out", request->out, "Folder for report.html and report.json; required")
      ->required()
      ->type_name("DIR");
  command->add_flag("--ply", request->ply, "Also write the last map as a mesh (map.ply) and as points (points.ply)");
  command->add_flag("--paraview", request->paraview,
                    "Also write the run as time series for ParaView: cells, frontiers, path, field");
  command->footer(
      "Examples:\n"
      "  vantage report night/run.record --out morning\n"
      "  vantage report night/run.record --out morning --ply --paraview");
  command->callback([request] { report(*request); });
}

}  // namespace vantage::apps
