// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/object_views.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

namespace detail {

inline void require_radii(const ObjectViewOptions& options) {
  require_option(!options.radii_m.empty(), "ObjectViewOptions::radii_m.size()", options.radii_m.size(), ">= 1");
}

}  // namespace detail

VANTAGE_INLINE AimedViewOptions ObjectViewOptions::aimed() const {
  detail::require_radii(*this);
  const double largest_m = *std::max_element(radii_m.begin(), radii_m.end());
  return {.count = aimed_candidates, .min_distance_m = largest_m / 3.0, .max_distance_m = largest_m};
}

VANTAGE_INLINE double fitting_radius_m(const Box& box, const RangeSensor& sensor, double resolution_m,
                                       double body_m) {
  const double reach_m = 0.5 * box.extent().norm();
  const double half_angle =
      std::min(0.5 * std::min(sensor.horizontal_angle_rad(), sensor.vertical_angle_rad()), std::asin(0.5));
  const double furthest_m = std::min(sensor.max_range_m - reach_m, sensor.resolving_range_m(resolution_m));
  const double nearest_m = std::max({sensor.min_range_m, 0.1, body_m}) + reach_m;
  return std::max(std::min(reach_m / std::sin(half_angle), furthest_m), nearest_m);
}

VANTAGE_INLINE ObjectViewOptions with_radii(const ObjectViewOptions& options, const RangeSensor& sensor,
                                            const Platform& platform, double resolution_m) {
  ObjectViewOptions all = options;
  if (all.radii_m.empty()) {
    const double body_m = std::max(resolution_m, std::isfinite(platform.reach_m()) ? platform.reach_m() : 0.0);
    all.radii_m = {fitting_radius_m(options.object, sensor, resolution_m, body_m + 2.0 * resolution_m)};
  }
  return all;
}

VANTAGE_INLINE std::vector<Pose> views_of_object(const ObjectViewOptions& options, const OccupancyMap& map,
                                                 const Platform& platform, std::span<const Pose> aimed,
                                                 std::uint64_t seed) {
  detail::require_radii(options);
  std::vector<Pose> views;
  const auto add = [&](std::span<const Pose> more) {
    for (const Pose& view : more) {
      const Pose pose = platform.facing(view.translation(), optical_axis(view));
      if (platform.admits(map, pose)) {
        views.push_back(pose);
      }
    }
  };
  const Eigen::Vector3d middle = options.object.centre();
  if (options.subdivisions >= 0) {
    add(views_around(middle, options.radii_m, options.subdivisions));
  }
  const VoxelBox cells = map.region() ? *map.region() : map.bounds().grown(1);
  if (options.random_candidates > 0 && !cells.empty()) {
    add(random_views_of(middle, map.frame().box_of(cells), options.random_candidates, seed));
  }
  add(aimed);
  return views;
}

}  // namespace vantage
