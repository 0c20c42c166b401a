// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/impl/targets_in_sight.hpp>

namespace vantage::detail {

VANTAGE_INLINE TargetsInSight::TargetsInSight(const SurveyedMap& surveyed, std::span<const FrontierTarget> targets,
                                              const Eigen::Vector3d& position, double furthest_m,
                                              std::uint64_t& operations)
    : sensor_(surveyed.sensor), tried_(surveyed.tried), place_(surveyed.map.frame().cell_of(position)) {
  const OccupancyMap& map = surveyed.map;
  for (const FrontierTarget& target : targets) {
    const Eigen::Vector3d line = map.frame().centre_of(target.unknown) - position;
    const double range_m = line.norm();
    if (range_m >= surveyed.sensor.min_range_m && range_m <= furthest_m &&
        (target.viewpoint == place_ || in_plain_sight(map, position, target.unknown, operations))) {
      sightings_.push_back({target.unknown, line});
    }
  }
}

VANTAGE_INLINE TargetView TargetsInSight::in_view(const Pose& pose) const {
  TargetView seen{.view = {.pose = pose}};
  for (const Sighting& sighting : sightings_) {
    if (sensor_.in_view(pose.linear().transpose() * sighting.line)) {
      seen.unknown.push_back(sighting.unknown);
    }
  }
  seen.view.utility = static_cast<double>(seen.unknown.size());
  return seen;
}

VANTAGE_INLINE void TargetsInSight::leave_out_tried() {
  std::erase_if(sightings_, [&](const Sighting& sighting) { return tried_.tried_from(sighting.unknown, place_); });
}

}  // namespace vantage::detail
