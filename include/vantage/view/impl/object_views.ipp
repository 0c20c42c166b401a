// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/object_views.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

VANTAGE_INLINE void validate(const ObjectViewOptions& options) {
  if (options.object.empty() || !options.object.min.allFinite() || !options.object.max.allFinite()) {
    throw std::invalid_argument("ObjectViewOptions::object must have min < max on every axis and be finite");
  }
  detail::require_option(!options.radii_m.empty(), "ObjectViewOptions::radii_m.size()", options.radii_m.size(),
                         ">= 1");
  for (const double radius_m : options.radii_m) {
    detail::require_option(std::isfinite(radius_m) && radius_m > 0.0, "ObjectViewOptions::radii_m", radius_m, "> 0");
  }
  detail::require_option(options.subdivisions >= -1 && options.subdivisions <= 6, "ObjectViewOptions::subdivisions",
                         options.subdivisions, "in [-1, 6]");
  validate(options.aimed);
}

VANTAGE_INLINE std::vector<Pose> views_of_object(const ObjectViewOptions& options, const OccupancyMap& map,
                                                 const Platform& platform, std::span<const Pose> aimed,
                                                 std::uint64_t seed) {
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
