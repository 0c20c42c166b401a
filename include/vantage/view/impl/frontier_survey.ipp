// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/view/frontier_survey.hpp>

namespace vantage {

VANTAGE_INLINE std::vector<VoxelIndex> FrontierSurvey::viewpoints() const {
  std::vector<VoxelIndex> cells(targets.size());
  std::transform(targets.begin(), targets.end(), cells.begin(),
                 [](const FrontierTarget& target) { return target.viewpoint; });
  return cells;
}

VANTAGE_INLINE std::optional<FrontierTarget> FrontierSurvey::target_seen_from(const VoxelIndex& viewpoint) const {
  const auto found = std::find_if(targets.begin(), targets.end(),
                                  [&](const FrontierTarget& target) { return target.viewpoint == viewpoint; });
  return found == targets.end() ? std::nullopt : std::optional(*found);
}

VANTAGE_INLINE bool in_plain_sight(const OccupancyMap& map, const Eigen::Vector3d& from, const VoxelIndex& target,
                                   std::uint64_t& operations) {
  return in_plain_sight(map, map.frame(), from, target, operations);
}

VANTAGE_INLINE bool sees(const OccupancyMap& map, const RangeSensor& sensor, const Pose& pose,
                         const VoxelIndex& unknown, std::uint64_t& operations) {
  const Eigen::Vector3d line = map.frame().centre_of(unknown) - pose.translation();
  const double range_m = line.norm();
  return range_m >= sensor.min_range_m && range_m <= sensor.max_range_m &&
         sensor.in_view(pose.linear().transpose() * line) &&
         in_plain_sight(map, pose.translation(), unknown, operations);
}

}  // namespace vantage
