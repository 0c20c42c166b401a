// SPDX-License-Identifier: MIT
#include "apps/run_files.hpp"

#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/picture/floor_plan.hpp>
#include <vantage/picture/void_picture.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/report/report_html.hpp>
#include <vantage/report/report_json.hpp>
#include <vector>

#include <vantage/map/impl/whole_file.hpp>
#include "apps/run_recording.hpp"

namespace vantage::apps {
namespace {

std::string title_of(const RunRecord& record) {
  return record.planner + " in " + std::filesystem::path(record.world).stem().string();
}

Picture floor_plan(const RunRecord& record, const OccupancyMap& map, const RangeSensor& sensor) {
  FloorPlanContent content;
  content.title = title_of(record) + ": map and path";
  content.travelled = record.travelled;
  for (const ViewRecord& view : record.views) {
    content.views.push_back(view.pose);
  }
  content.show_directions = sensor.horizontal_angle_rad() < 2.0 * std::numbers::pi - 0.1;
  return draw_floor_plan(map, content);
}

void add_void_pictures(const VoidSearch& search, const OccupancyMap& map, const Pose& sensor,
                       const std::string& after, std::map<std::string, Picture>& pictures) {
  std::vector<VoxelIndex> voids;
  search.voids.for_each_cell([&](const VoxelIndex& cell) { voids.push_back(cell); });
  std::vector<Ellipsoid> ellipsoids;
  for (const FrontierVoid& one : search.frontier_voids) {
    ellipsoids.push_back(search.voids.clusters()[one.cluster].ellipsoid);
  }
  VoidContent content;
  content.voids = voids;
  content.frontier = search.frontier;
  content.ellipsoids = ellipsoids;
  content.places = search.places;
  content.utility = search.utility;
  content.sensor = sensor;
  content.view = search.view;
  content.title = "voids and frontiers" + after;
  pictures["voids.png"] = draw_voids(map, content);
  content.title = "places from which voids may be seen" + after;
  pictures["void_utility.png"] = draw_void_utility(map, content);
}

}  // namespace

void PlanPictures::look(const ExplorationPlanner& planner, const OccupancyMap& map, const ViewRecord& view) {
  const auto* searcher = dynamic_cast<const FrontierVoidPlanner*>(&planner);
  if (searcher != nullptr && searcher->search().frontier_voids.size() > most_voids_) {
    most_voids_ = searcher->search().frontier_voids.size();
    add_void_pictures(searcher->search(), map, view.pose, " after view " + std::to_string(view.view), pictures_);
  }
}

bool OutputFiles::attempt(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const std::runtime_error& error) {
    if (errors_.find(error.what()) == std::string::npos) {
      errors_ += (errors_.empty() ? "" : "; ") + std::string(error.what());
    }
    return false;
  }
}

void OutputFiles::write(const std::filesystem::path& file,
                        const std::function<void(const std::filesystem::path&)>& write) {
  if (attempt([&] { write(file); })) {
    add(file);
  }
}

void OutputFiles::check() const {
  if (!errors_.empty()) {
    throw std::runtime_error(errors_);
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() + ": cannot be made: " + error.message());
  }
}

void make_run_folder(const std::filesystem::path& folder) {
  make_folder(folder);
  std::error_code ignored;
  std::error_code error;
  const auto remove = [&](const std::filesystem::path& file) {
    if (!error) {
      std::filesystem::remove(file, error);
    }
    if (error == std::errc::directory_not_empty) {  // no file of a run; the one of that name cannot be written
      error.clear();
    }
  };
  for (const char* name : {"report.json", "report.html", "run.record", "map.ot", "floor_plan.png", "voids.png",
                           "void_utility.png", "selection.json"}) {
    remove(folder / name);
    remove(folder / (std::string(name) + ".part"));
  }
  if (std::filesystem::is_directory(folder / "frames", ignored)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
      if (entry.path().extension() == ".png" || entry.path().extension() == ".part") {
        remove(entry.path());
      }
    }
  }
  if (error) {
    throw std::runtime_error(folder.string() +
                             ": what a run before left there cannot be removed: " + error.message());
  }
}

void tell_files(std::ostream& out, const std::vector<std::filesystem::path>& files) {
  out << "\nwrote\n";
  for (const std::filesystem::path& file : files) {
    out << "  " << file.string() << '\n';
  }
}

void give_json(const std::string& json, const std::string& report) {
  if (json == "-") {
    std::cout << report << std::flush;
  } else if (!json.empty()) {
    detail::write_whole_file(json, report);
  }
}

void write_page(const RunRecording& recording, const std::string& report, OutputFiles& files) {
  if (files.attempt([&] { recording.check(); }) && recording.file()) {
    files.add(*recording.file());
  }
  if (recording.file()) {
    files.write(recording.file()->parent_path() / "report.html", [&](const std::filesystem::path& file) {
      write_report_html(std::vector<ReportedRun>{{report, *recording.file()}}, file);
    });
  }
}

namespace {

// Makes the folder as a run would, and removes again what did not exist before.
void try_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> made;  // innermost first
  for (std::filesystem::path at = std::filesystem::absolute(folder).lexically_normal();
       !std::filesystem::exists(at) && at.has_relative_path(); at = at.parent_path()) {
    made.push_back(at);
  }
  make_folder(folder);
  const auto remove_made = [&] {
    std::error_code ignored;
    for (const std::filesystem::path& each : made) {
      std::filesystem::remove(each, ignored);
    }
  };
  try {
    detail::try_whole_file(folder / "report.json");
  } catch (const std::runtime_error&) {
    remove_made();
    throw;
  }
  remove_made();
}

}  // namespace

void check_targets(const std::string& out, const std::string& json) {
  const auto naming = [](const char* option, const auto& act) {
    try {
      act();
    } catch (const std::exception& error) {
      throw std::runtime_error(option + std::string(" ") + error.what());
    }
  };
  if (!out.empty()) {
    naming("--out", [&] {
      if (std::filesystem::exists(out) && !std::filesystem::is_directory(out)) {
        throw std::runtime_error(out + ": is not a folder");
      }
      try_folder(out);
    });
  }
  if (!json.empty() && json != "-") {
    naming("--json", [&] { detail::try_whole_file(json); });
  }
}

void write_outputs(const std::string& out, const std::string& json, const RunRecord& run, const OccupancyMap& map,
                   const RangeSensor& sensor, const std::map<std::string, Picture>& pictures, std::ostream& progress,
                   const RunRecording& recording) {
  using std::filesystem::path;
  OutputFiles files;
  if (!out.empty()) {
    const path folder = out;
    files.write(folder / "report.json", [&](const path& file) { write_report_json(run, file); });
    files.write(folder / "map.ot", [&](const path& file) { save_octomap(map, file); });
    files.write(folder / "floor_plan.png", [&](const path& file) { write_png(floor_plan(run, map, sensor), file); });
    for (const auto& [name, picture] : pictures) {
      files.write(folder / name, [&picture = picture](const path& file) { write_png(picture, file); });
    }
    write_page(recording, report_json(run), files);
    tell_files(progress, files.written());
  }
  files.attempt([&] { give_json(json, report_json(run)); });
  files.check();
}

}  // namespace vantage::apps
