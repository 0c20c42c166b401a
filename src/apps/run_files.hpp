// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/picture/picture.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>
#include <vector>

namespace vantage::apps {

class RunRecording;

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

/// The files of a run. One that cannot be written keeps no other from being written.
class OutputFiles {
 public:
  /// Calls `write`. A std::runtime_error that it throws is kept; returns whether there was none.
  bool attempt(const std::function<void()>& write);
  /// Attempts to write `file`, which is listed if that succeeds.
  void write(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);
  /// Lists what was written elsewhere.
  void add(const std::filesystem::path& file) { written_.push_back(file); }
  [[nodiscard]] const std::vector<std::filesystem::path>& written() const { return written_; }
  /// Throws std::runtime_error with all errors that were kept, if there are any.
  void check() const;

 private:
  std::vector<std::filesystem::path> written_;
  std::string errors_;
};

/// Creates a folder and its parents. Throws std::runtime_error with its path.
void make_folder(const std::filesystem::path& folder);
/// Creates the folder of a run and removes the files that an earlier run may have left there, and no others. Throws
/// std::runtime_error.
void make_run_folder(const std::filesystem::path& folder);

/// Prints the list of files at the end of a run.
void tell_files(std::ostream& out, const std::vector<std::filesystem::path>& files);
/// Writes the report to the file `json`, to stdout if that is "-", or nowhere if it is empty. Throws
/// std::runtime_error with the path if it cannot be written.
void give_json(const std::string& json, const std::string& report);

/// Lists the record of a run in `files`, or keeps its error there, and writes its page, report.html, beside it.
void write_page(const RunRecording& recording, const std::string& report, OutputFiles& files);

/// Tests before a run whether files can be made for --out and --json; leaves nothing behind. Throws
/// std::runtime_error with the path that cannot be written.
void check_targets(const std::string& out, const std::string& json);
/// Writes the outputs of a run: if `out` names a folder, report.json, map.ot, the pictures and, from the record,
/// report.html there, listed on `progress`; its report to the file `json`, or to stdout if that is "-". Then throws
/// std::runtime_error if any, or the record, could not be written.
void write_outputs(const std::string& out, const std::string& json, const RunRecord& run, const OccupancyMap& map,
                   const RangeSensor& sensor, const std::map<std::string, Picture>& pictures, std::ostream& progress,
                   const RunRecording& recording);

}  // namespace vantage::apps
