// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vantage/view/target_view.hpp>

#include <vantage/view/impl/targets_in_sight.hpp>

namespace vantage {
namespace detail {

// The view of `wanted` from `position` that sees most targets, of orientations in which the body has room there.
// `otherwise` if there is none.
inline TargetView view_with_room(const SurveyedMap& surveyed, const FrontierTarget& wanted,
                                 const Eigen::Vector3d& position, const TargetsInSight& in_sight,
                                 TargetView otherwise) {
  const Eigen::Vector3d line = surveyed.map.frame().centre_of(wanted.unknown) - position;
  TargetView best = std::move(otherwise);
  double most = 0.0;
  for (const VoxelIndex& step : kAllNeighbours) {
    const Pose pose = surveyed.platform.facing(position, Eigen::Vector3d(step.x, step.y, step.z));
    TargetView candidate = in_sight.in_view(pose);
    if (candidate.view.utility > most && surveyed.sensor.in_view(pose.linear().transpose() * line) &&
        surveyed.platform.admits(surveyed.map, pose)) {
      most = candidate.view.utility;
      best = std::move(candidate);
    }
  }
  return best;
}

}  // namespace detail

VANTAGE_INLINE TargetView targets_seen_from(const SurveyedMap& surveyed, const Pose& pose,
                                            std::uint64_t& operations) {
  const OccupancyMap& map = surveyed.map;
  const RangeSensor& sensor = surveyed.sensor;
  const double furthest_m = detail::counted_range_m(map, sensor);
  const VoxelIndex place = map.frame().cell_of(pose.translation());
  TargetView seen{.view = {.pose = pose}};
  if (surveyed.tried.rests(place)) {
    return seen;
  }
  for (const FrontierTarget& target : surveyed.survey.targets) {
    const Eigen::Vector3d line = map.frame().centre_of(target.unknown) - pose.translation();
    const bool in_sight = target.viewpoint == place
                              ? sensor.in_view(pose.linear().transpose() * line)
                              : line.norm() <= furthest_m && sees(map, sensor, pose, target.unknown, operations);
    if (in_sight) {
      seen.unknown.push_back(target.unknown);
    }
  }
  seen.view.utility = static_cast<double>(seen.unknown.size());
  return seen;
}

VANTAGE_INLINE TargetView view_of_target(const SurveyedMap& surveyed, const FrontierTarget& wanted,
                                         std::uint64_t& operations) {
  const OccupancyMap& map = surveyed.map;
  const RangeSensor& sensor = surveyed.sensor;
  const Platform& platform = surveyed.platform;
  const Eigen::Vector3d position = surveyed.reachable.position_in(wanted.viewpoint);
  const Eigen::Vector3d line = map.frame().centre_of(wanted.unknown) - position;
  const double furthest_m = std::max(detail::counted_range_m(map, sensor), line.norm());
  const detail::TargetsInSight in_sight(surveyed, surveyed.survey.targets, position, furthest_m, operations);
  TargetView best = in_sight.in_view(platform.facing(position, line));
  // Orientations half-way between the wanted target and about 32 others, evenly chosen from the list: more of them
  // come into view together with the wanted one.
  constexpr std::size_t kTried = 32;
  const std::size_t stride = in_sight.all().size() / kTried + 1;
  for (std::size_t i = 0; i < in_sight.all().size(); i += stride) {
    const Eigen::Vector3d between = line.normalized() + in_sight.all()[i].line.normalized();
    if (between.norm() < 1e-3) {
      continue;
    }
    const Pose pose = platform.facing(position, between);
    if (!sensor.in_view(pose.linear().transpose() * line)) {
      continue;
    }
    TargetView candidate = in_sight.in_view(pose);
    if (candidate.view.utility > best.view.utility) {
      best = std::move(candidate);
    }
  }
  // A body that is no sphere may have no room for this orientation.
  if (platform.admits(map, best.view.pose)) {
    return best;
  }
  return detail::view_with_room(surveyed, wanted, position, in_sight, std::move(best));
}

}  // namespace vantage
