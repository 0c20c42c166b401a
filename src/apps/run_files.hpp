// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/picture/picture.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>
#include <vector>

namespace vantage::apps {

/// Keeps the most telling pictures of all plans of a run: those with the most voids that have a frontier.
class PlanPictures {
 public:
  /// Called right after a planner made a plan for `map` where `view` was taken. Most planners leave no picture.
  void look(const ExplorationPlanner& planner, const OccupancyMap& map, const ViewRecord& view);
  /// The pictures by file name.
  [[nodiscard]] const std::map<std::string, Picture>& pictures() const { return pictures_; }

 private:
  std::size_t most_voids_ = 0;
  std::map<std::string, Picture> pictures_;
};

/// Creates a folder and its parents. Throws std::runtime_error with its path.
void make_folder(const std::filesystem::path& folder);
/// Creates the folder of a run and removes the files that an earlier run may have left there, and no others.
void make_run_folder(const std::filesystem::path& folder);

/// Writes report.json, map.ot, the pictures and, if the run left a record, report.html into `folder`, which is
/// created. Returns the files in order, including the record. Throws std::runtime_error with the path that cannot
/// be written.
std::vector<std::filesystem::path> write_run_files(const std::filesystem::path& folder, const RunRecord& run,
                                                   const OccupancyMap& map, const RangeSensor& sensor,
                                                   const std::map<std::string, Picture>& pictures,
                                                   const std::optional<std::filesystem::path>& record = std::nullopt);

/// Prints the list of files at the end of a run.
void tell_files(std::ostream& out, const std::vector<std::filesystem::path>& files);
/// Writes the report to the file `json`, to stdout if that is "-", or nowhere if it is empty. Throws
/// std::runtime_error with the path if it cannot be written.
void give_json(const std::string& json, const std::string& report);

/// Tests before a run whether files can be made for --out and --json; leaves nothing behind. Throws
/// std::runtime_error with the path that cannot be written.
void check_targets(const std::string& out, const std::string& json);
/// Writes the outputs of a run: its files if `out` names a folder, listed on `progress`, and its report to the
/// file `json`, or to stdout if that is "-".
void write_outputs(const std::string& out, const std::string& json, const RunRecord& run, const OccupancyMap& map,
                   const RangeSensor& sensor, const std::map<std::string, Picture>& pictures, std::ostream& progress,
                   const std::optional<std::filesystem::path>& record = std::nullopt);

}  // namespace vantage::apps
