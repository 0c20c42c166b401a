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

/// Reads what a RunRecorder wrote, cycle by cycle. The record may still be growing or may have been cut off.
///
///     RunRecordReader reader("night.run");
///     OccupancyMap map = reader.new_map();
///     while (const auto cycle = reader.next()) {
///       apply_changes(*cycle, map);
///     }
///     if (!reader.tail().empty()) std::cerr << reader.tail() << '\n';
class RunRecordReader {
 public:
  /// Reads the head of the record. Throws std::runtime_error with the path if the file cannot be read, is no
  /// record or ends within its head.
  explicit RunRecordReader(const std::filesystem::path& file);
  RunRecordReader(RunRecordReader&&) noexcept;             ///< The object moved from must not be used.
  RunRecordReader& operator=(RunRecordReader&&) noexcept;  ///< The object moved from must not be used.
  RunRecordReader(const RunRecordReader&) = delete;
  RunRecordReader& operator=(const RunRecordReader&) = delete;
  ~RunRecordReader();

  /// The sensor of the run.
  [[nodiscard]] const RangeSensor& sensor() const;
  /// An empty map with the resolution and region of the recorded map; 0.1 m if there is no cycle.
  [[nodiscard]] OccupancyMap new_map() const;

  /// The next cycle; none at the end of the record, complete or not.
  [[nodiscard]] std::optional<RecordedCycle> next();

  /// The run as far as it has been read; all of it once `next` has returned none. An unfinished record has the
  /// outcome Budget and says so in `reason`.
  [[nodiscard]] const RunRecord& run() const;
  /// Whether the end of the run has been read.
  [[nodiscard]] bool finished() const;
  /// One sentence on unusable bytes after the last cycle, for example after a crash; empty if everything was read.
  /// Valid once `next` has returned none.
  [[nodiscard]] const std::string& tail() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace vantage
