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

VANTAGE_INLINE bool FreeFlyer::has_room(const OccupancyMap& map, const Eigen::Vector3d& position) const {
  const double radius_m = detail::clear_m(options_, map);
  return height_allowed(position.z()) && !detail::is_larger_than_known(map, radius_m) &&
         detail::swept_sphere_is_clear(map.frame(), position, position, radius_m,
                                       [&](const VoxelIndex& cell) { return map.is_clear(cell); });
}

VANTAGE_INLINE bool FreeFlyer::admits(const OccupancyMap& map, const Pose& pose) const {
  return is_rigid(pose) && map.frame().addressable(pose.translation()) &&
         !(options_.yaw_only && std::abs(optical_axis(pose).z()) > 1e-6) && has_room(map, pose.translation());
}

VANTAGE_INLINE bool FreeFlyer::admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const {
  return has_room(map, map.frame().centre_of(cell));
}

VANTAGE_INLINE VoxelGrid<std::uint8_t> FreeFlyer::admitted_cells(const OccupancyMap& map, const VoxelBox& box) const {
  if (detail::is_larger_than_known(map, detail::clear_m(options_, map))) {
    return VoxelGrid<std::uint8_t>(box);
  }
  VoxelGrid<std::uint8_t> admitted =
      detail::cells_for_body(map, box, detail::touched_by_sphere(map.frame(), detail::clear_m(options_, map)));
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
  const double radius_m = detail::clear_m(options_, map);
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
