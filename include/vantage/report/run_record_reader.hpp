// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/recorded_cycle.hpp>
#include <vantage/report/run_record.hpp>

namespace VANTAGE_EXPORT vantage {

/// Reads what a RunRecorder wrote, cycle by cycle, also while it is still being written or after it was cut off.
///
///     RunRecordReader reader("night.run");
///     OccupancyMap map = reader.new_map();
///     while (const auto cycle = reader.next()) {
///       apply_changes(*cycle, map);
///     }
///     if (!reader.tail().empty()) std::cerr << reader.tail() << '\n';
class RunRecordReader {
 public:
  /// Reads the head of the record. Throws std::runtime_error naming the file if it cannot be read, is no record or
  /// ends within its head.
  explicit RunRecordReader(const std::filesystem::path& file);
  RunRecordReader(RunRecordReader&&) noexcept;             ///< The one moved from is of no more use.
  RunRecordReader& operator=(RunRecordReader&&) noexcept;  ///< The one moved from is of no more use.
  RunRecordReader(const RunRecordReader&) = delete;
  RunRecordReader& operator=(const RunRecordReader&) = delete;
  ~RunRecordReader();

  /// The sensor of the run.
  [[nodiscard]] const RangeSensor& sensor() const;
  /// An empty map with the resolution and region of the one that was recorded; with a resolution of 0.1 m where no
  /// cycle was.
  [[nodiscard]] OccupancyMap new_map() const;

  /// The next cycle; none where the record ends, whether as it should or not.
  [[nodiscard]] std::optional<RecordedCycle> next();

  /// The run as far as it has been read: all of it after `next` has returned none. A record that was not finished
  /// has the outcome Budget and says so in `reason`.
  [[nodiscard]] const RunRecord& run() const;
  /// Whether the end of the run has been read.
  [[nodiscard]] bool finished() const;
  /// After the last cycle: one sentence on what follows that could not be used, as after a crash; empty where all
  /// was read.
  [[nodiscard]] const std::string& tail() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
