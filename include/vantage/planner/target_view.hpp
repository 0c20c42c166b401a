// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/frontier_survey.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

class Situation;

/// A view and what it is meant to resolve.
struct TargetView {
  View view;                             ///< utility: the number of frontier targets seen
  std::vector<VoxelIndex> unknown = {};  ///< their unknown cells, in the order of the survey's targets
  /// Unknown cells that it may resolve besides; they were looked at in vain if it resolves none of them.
  std::vector<VoxelIndex> hoped = {};
};

/// What a given pose sees of the targets of the situation's survey, no further off than the sensor resolves cells of
/// the map (RangeSensor::resolving_range_m). `operations` counts the cells that lines of sight visit.
[[nodiscard]] TargetView targets_seen_from(const Situation& situation, const Pose& pose, std::uint64_t& operations);

/// The pose at the viewpoint of `wanted` that sees `wanted` and, of the orientations tried, most other targets too
/// that are near enough to be resolved.
[[nodiscard]] TargetView view_of_target(const Situation& situation, const FrontierTarget& wanted,
                                        std::uint64_t& operations);

}  // namespace vantage
