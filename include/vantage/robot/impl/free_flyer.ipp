// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/robot/impl/body_cells.hpp>
#include <vantage/robot/impl/swept_sphere.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
VANTAGE_INLINE FreeFlyer::FreeFlyer(const FreeFlyerOptions& options) : options_(options) {
  detail::require_length(options.radius_m, "FreeFlyerOptions::radius_m");
  detail::require_length(options.margin_m.value_or(0.0), "FreeFlyerOptions::margin_m");
  detail::require_option(options.min_height_m <= options.max_height_m, "FreeFlyerOptions::min_height_m",
                         options.min_height_m, "<= max_height_m");
}

// How far from the sensor all cells of this map must be clear.
VANTAGE_INLINE double FreeFlyer::clear_m(const OccupancyMap& map) const {
  return options_.margin_m ? reach_m() : std::max(reach_m(), map.resolution_m());
}

VANTAGE_INLINE bool FreeFlyer::admits(const OccupancyMap& map, const Pose& pose) const {
  const Eigen::Vector3d position = pose.translation();
  if (!is_rigid(pose) || !map.frame().addressable(position) || !height_allowed(position.z())) {
    return false;
  }
  if (detail::is_larger_than_known(map, clear_m(map)) ||
      (options_.yaw_only && std::abs(optical_axis(pose).z()) > 1e-6)) {
    return false;
  }
  return detail::swept_sphere_is_clear(map.frame(), position, position, clear_m(map),
                                       [&](const VoxelIndex& cell) { return map.is_clear(cell); });
}

VANTAGE_INLINE bool FreeFlyer::admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const {
  const Eigen::Vector3d centre = map.frame().centre_of(cell);
  return height_allowed(centre.z()) && !detail::is_larger_than_known(map, clear_m(map)) &&
         detail::swept_sphere_is_clear(map.frame(), centre, centre, clear_m(map),
                                       [&](const VoxelIndex& touched) { return map.is_clear(touched); });
}

VANTAGE_INLINE VoxelGrid<std::uint8_t> FreeFlyer::admitted_cells(const OccupancyMap& map, const VoxelBox& box) const {
  if (detail::is_larger_than_known(map, clear_m(map))) {
    return VoxelGrid<std::uint8_t>(box);
  }
  VoxelGrid<std::uint8_t> admitted =
      detail::cells_for_body(map, box, detail::touched_by_sphere(map.frame(), clear_m(map)));
  for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) {
    if (!height_allowed(map.frame().centre_of({0, 0, z}).z())) {
      for_each_cell({{box.lo.x, box.lo.y, z}, {box.hi.x, box.hi.y, z + 1}},
                    [&](const VoxelIndex& cell) { admitted[cell] = 0; });
    }
  }
  return admitted;
}

VANTAGE_INLINE bool FreeFlyer::admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const VoxelFrame& frame = map.frame();
  const Eigen::Vector3d a = from.translation();
  const Eigen::Vector3d b = to.translation();
  const double radius_m = clear_m(map);
  if (!frame.addressable(a) || !frame.addressable(b) || !height_allowed(b.z()) ||
      detail::is_larger_than_known(map, radius_m)) {
    return false;
  }
  return detail::swept_sphere_is_clear(frame, a, b, radius_m, [&](const VoxelIndex& cell) {
    return map.is_clear(cell) || detail::sphere_touches(frame, a, radius_m, cell);
  });
}

VANTAGE_INLINE Pose FreeFlyer::facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const {
  return options_.yaw_only ? pose_looking_level(position_m, direction) : pose_looking_along(position_m, direction);
}

VANTAGE_INLINE double FreeFlyer::distance_m(const Pose& from, const Pose& to) const {
  return (to.translation() - from.translation()).norm();
}

VANTAGE_INLINE std::optional<std::vector<Pose>> FreeFlyer::path(const OccupancyMap& map, const Pose& from,
                                                                const Pose& to) const {
  return grid_path(map, *this, from, to);
}

VANTAGE_INLINE Box FreeFlyer::body_box(const Pose& pose) const {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(std::max(reach_m(), 1e-9));
  return {pose.translation() - reach, pose.translation() + reach};
}

}  // namespace vantage
