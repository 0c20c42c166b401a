// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>

namespace vantage::detail {

/// What the first chunk of a record holds.
struct RecordHead {
  RunRecord run;  ///< what is known before the first cycle
  RangeSensor sensor;
  std::optional<VoxelBox> region;
};

// To JSON and back. Missing keys keep their defaults. Reading throws std::runtime_error for text that is not such
// JSON.
[[nodiscard]] std::string head_json(const RecordHead& head);
[[nodiscard]] RecordHead head_of(const std::string& json);
/// What is known only at the end of a run, as JSON.
[[nodiscard]] std::string end_json(const RunRecord& run);
void read_end(const std::string& json, RunRecord& run);

}  // namespace vantage::detail
