// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <vantage/report/map_export.hpp>
#include <vantage/report/report_html.hpp>
#include <vantage/report/report_json.hpp>
#include <vantage/report/run_record_reader.hpp>
#include <vector>

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
  const std::filesystem::path folder = request.out;
  make_folder(folder);
  write_report_json(run, folder / "report.json");
  write_report_html(request.record, folder / "report.html");
  std::cout << run.planner << " in " << run.world << ": " << run.views.size() << " views, " << to_string(run.outcome)
            << ": " << run.reason << '\n';
  if (!reader.tail().empty()) {
    std::cout << "What follows the last view could not be used: " << reader.tail() << '\n';
  }
  std::vector<std::filesystem::path> files{folder / "report.json", folder / "report.html"};
  if (request.ply) {
    files.insert(files.end(), {folder / "map.ply", folder / "points.ply"});
    write_ply_mesh(map, folder / "map.ply");
    write_ply_points(map, folder / "points.ply");
  }
  if (request.paraview) {
    const std::vector<std::filesystem::path> series = write_paraview(request.record, folder);
    files.insert(files.end(), series.begin(), series.end());
  }
  tell_files(std::cout, files);
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
