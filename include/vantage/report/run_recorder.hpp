// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>

namespace VANTAGE_EXPORT vantage {

/// The head of a record: names, seed and sensor of the run, and how the record is written.
struct RunRecorderSetup {
  std::string command = "host";  ///< what drives the run; the program writes its command
  std::string world = {};        ///< name of the place, for a person
  std::string planner = {};      ///< NAME of the planner
  std::uint64_t seed = 1;        ///< seed of everything random
  int threads = 1;               ///< threads given to the planner
  RangeSensor sensor = {};       ///< the sensor; the replay draws its field of view
  /// Largest number of samples of the planner's field per cycle; 0: none.
  std::size_t field_samples = 3000;
  /// Whether each cycle waits until it is on the disk. Without it a record survives the end of the process, but
  /// the last seconds may be lost in a power failure.
  bool sync = false;
};

/// Writes a run to a file while it goes on: what changed in the map, where the sensor was, what was planned.
///
///     RunRecorder recorder("night.run", {.world = "lab", .planner = "harmonic", .sensor = sensor});
///     for (;;) {
///       map.insert(scan);
///       const Plan plan = planner->plan(map, pose);
///       recorder.record(map, pose, plan);
///       ...
///     }
///     recorder.finish(RunOutcome::Explored, plan.reason);
///
/// The file only grows, by one checked chunk per cycle (docs/record.md). Whatever ends the process, the record can
/// be read up to the last complete cycle (RunRecordReader). The cost of a cycle follows the changes of the map and
/// is small beside the insertion of the scan. The recorder keeps a copy of the cell states, 2 bits per cell.
class RunRecorder {
 public:
  /// Creates the file or replaces it. Throws std::runtime_error with the path if it cannot be written.
  RunRecorder(const std::filesystem::path& file, const RunRecorderSetup& setup);
  RunRecorder(RunRecorder&&) noexcept;             ///< The object moved from must not be used.
  RunRecorder& operator=(RunRecorder&&) noexcept;  ///< The object moved from must not be used.
  RunRecorder(const RunRecorder&) = delete;
  RunRecorder& operator=(const RunRecorder&) = delete;
  /// Closes the file. A record without `finish` stays unfinished, and its reader says so.
  ~RunRecorder();

  /// Records the scan just inserted into `map` and, if one was made, the plan after it and the field of the
  /// planner. All views are of one map with one resolution, which the first call sets. The figures of `view` are
  /// kept as they are, except those that a plan gives: utility, outcome, and frontier and void cells if it counted
  /// any. Throws std::runtime_error with the path if the file cannot be written; the record then ends with the
  /// previous cycle. Throws std::invalid_argument if the resolution changes and std::logic_error if the record has
  /// ended.
  void record(const OccupancyMap& map, ViewRecord view, const Plan* plan = nullptr,
              const HarmonicField* field = nullptr);
  /// Records a scan and the plan after it, for hosts that keep no ViewRecord: counts the views and measures the
  /// path straight from pose to pose. Throws as the overload above.
  void record(const OccupancyMap& map, const Pose& world_from_sensor, const Plan& plan, double insert_ms = 0.0,
              double plan_ms = 0.0);

  /// Ends the record. `run.views` may be empty. Further calls of `record` and `finish` throw std::logic_error.
  void finish(const RunRecord& run);
  /// Ends the record, for hosts that keep no RunRecord. Otherwise as the overload above.
  void finish(RunOutcome outcome, const std::string& reason);

  /// Length of the file so far, bytes.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
