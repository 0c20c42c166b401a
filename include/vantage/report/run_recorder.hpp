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

/// What a record says of the run before its first cycle.
struct RunRecorderSetup {
  std::string command = "host";  ///< what drives the run; the program writes its command here
  std::string world = {};        ///< where it takes place, for a person
  std::string planner = {};      ///< by its NAME
  std::uint64_t seed = 1;        ///< of everything random in the run
  int threads = 1;               ///< the planner is given
  RangeSensor sensor = {};       ///< whose field of view the replay shows
  /// Samples of a planner's field that a cycle may keep; 0: none.
  std::size_t field_samples = 3000;
  /// Whether every cycle waits until it lies on the disk. Without, a record survives the end of the process by
  /// whatever cause, but the last seconds may be lost when the power fails.
  bool sync = false;
};

/// Writes a run to a file as it goes: what changed in the map, where the sensor was, what was planned.
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
/// The file only grows, one checked chunk per cycle (docs/record.md), so whatever ends the process, the record up to
/// the last finished cycle opens (RunRecordReader). A cycle costs what the map's change log names, a small part of
/// what inserting the scan did; a copy of the states of the map's cells is kept, 2 bits a cell.
class RunRecorder {
 public:
  /// Makes the file or replaces it. Throws std::runtime_error naming it if it cannot be written.
  RunRecorder(const std::filesystem::path& file, const RunRecorderSetup& setup);
  RunRecorder(RunRecorder&&) noexcept;             ///< The one moved from is of no more use.
  RunRecorder& operator=(RunRecorder&&) noexcept;  ///< The one moved from is of no more use.
  RunRecorder(const RunRecorder&) = delete;
  RunRecorder& operator=(const RunRecorder&) = delete;
  /// A record that was not finished stays one: its reader says so.
  ~RunRecorder();

  /// Records the scan just inserted into `map` and, where one was made, the plan that came of it, with the field
  /// behind it. Views come in order, all of one map and one resolution, which the first call sets. The numbers of
  /// `view` are taken as they are, but utility and outcome from a plan, and frontier and void cells too where it
  /// counted any. Throws std::runtime_error naming the file if it cannot be written, which ends the record with
  /// the cycle before; std::invalid_argument if the resolution changes; std::logic_error if the record has ended.
  void record(const OccupancyMap& map, ViewRecord view, const Plan* plan = nullptr,
              const HarmonicField* field = nullptr);
  /// The same for hosts that keep no ViewRecord: counts views and metres (straight from pose to pose) itself.
  void record(const OccupancyMap& map, const Pose& world_from_sensor, const Plan& plan, double insert_ms = 0.0,
              double plan_ms = 0.0);

  /// Ends the record with how the run ended. `run.views` may be empty. Nothing may be recorded afterwards.
  void finish(const RunRecord& run);
  /// The same for hosts that keep no RunRecord.
  void finish(RunOutcome outcome, const std::string& reason);

  /// Length of the file so far.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
