// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>
#include <vantage/vision/picture.hpp>
#include <vector>

namespace vantage::apps {

/// Keeps, of all plans of a run, the pictures of those that show most: of the field with the longest way downhill,
/// and of the most voids with a frontier.
class PlanPictures {
 public:
  /// Looks at a planner right after it made a plan for `map` where `view` was taken; most planners leave no picture.
  void look(const ExplorationPlanner& planner, const OccupancyMap& map, const ViewRecord& view);
  /// By the names of their files.
  [[nodiscard]] const std::map<std::string, Picture>& pictures() const { return pictures_; }

 private:
  double longest_m_ = 0.0;
  std::size_t most_voids_ = 0;
  std::map<std::string, Picture> pictures_;
};

/// Makes a folder and those above it where they are missing. Throws std::runtime_error naming it.
void make_folder(const std::filesystem::path& folder);
/// The same for the files of one run: removes those that a run before may have left there, and nothing else.
void make_run_folder(const std::filesystem::path& folder);

/// Writes report.json, map.ot and the pictures into `folder`, which is made, and where the run left a record there,
/// report.html; returns the files in order, the record among them. Throws
/// std::runtime_error naming what cannot be written.
std::vector<std::filesystem::path> write_run_files(const std::filesystem::path& folder, const RunRecord& run,
                                                   const OccupancyMap& map, const RangeSensor& sensor,
                                                   const std::map<std::string, Picture>& pictures,
                                                   const std::optional<std::filesystem::path>& record = std::nullopt);

/// Tells, at the end, which files there are now.
void tell_files(std::ostream& out, const std::vector<std::filesystem::path>& files);
/// The report of a run to where `json` names a file or, as "-", to stdout; nowhere where it is empty. Throws
/// std::runtime_error naming the file if it cannot be written.
void give_json(const std::string& json, const std::string& report);

/// Tries, before a run, to begin a file in --out and --json, and leaves nothing behind. Throws std::runtime_error
/// naming the one that cannot be written.
void check_targets(const std::string& out, const std::string& json);
/// After a run: its files where `out` names a folder, telling `progress` which, and its report where `json` names a
/// file or, as "-", stdout.
void write_outputs(const std::string& out, const std::string& json, const RunRecord& run, const OccupancyMap& map,
                   const RangeSensor& sensor, const std::map<std::string, Picture>& pictures, std::ostream& progress,
                   const std::optional<std::filesystem::path>& record = std::nullopt);

}  // namespace vantage::apps
