// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/report/run_record.hpp>

namespace vantage::detail {

/// What the first chunk of a record says.
struct RecordHead {
  RunRecord run;  ///< what is known before the first cycle
  RangeSensor sensor;
  std::optional<VoxelBox> region;
};

// As JSON, and back; what is missing keeps its default. Reading throws std::runtime_error for what is none.
[[nodiscard]] std::string head_json(const RecordHead& head);
[[nodiscard]] RecordHead head_of(const std::string& json);
/// What is known only at the end of a run.
[[nodiscard]] std::string end_json(const RunRecord& run);
void read_end(const std::string& json, RunRecord& run);

}  // namespace vantage::detail
