// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/ground_robot.hpp>

#include <vantage/robot/impl/body_cells.hpp>
#include <vantage/robot/impl/swept_sphere.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

VANTAGE_INLINE GroundRobot::GroundRobot(const GroundRobotOptions& options) : options_(options) {
  detail::require_length(options.radius_m, "GroundRobotOptions::radius_m");
  detail::require_length(options.margin_m.value_or(0.0), "GroundRobotOptions::margin_m");
}

VANTAGE_INLINE bool GroundRobot::admits(const OccupancyMap& map, const Pose& pose) const {
  const Eigen::Vector3d position = pose.translation();
  if (!is_rigid(pose) || !map.frame().addressable(position) || std::abs(optical_axis(pose).z()) > 1e-6 ||
      detail::disc_is_larger_than_known(map, detail::clear_m(options_, map))) {
    return false;
  }
  const std::int32_t layer = map.frame().cell_of(position).z;
  return detail::swept_sphere_is_clear(map.frame(), position, position, detail::clear_m(options_, map),
                                       [&](const VoxelIndex& cell) { return map.is_clear(cell); },
                                       {layer, layer + 1});
}

VANTAGE_INLINE bool GroundRobot::admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const {
  return admits(map, pose_looking(map.frame().centre_of(cell), 0.0));
}

VANTAGE_INLINE VoxelGrid<std::uint8_t> GroundRobot::admitted_cells(const OccupancyMap& map,
                                                                   const VoxelBox& box) const {
  if (detail::disc_is_larger_than_known(map, detail::clear_m(options_, map))) {
    return VoxelGrid<std::uint8_t>(box);
  }
  return detail::cells_for_body(map, box, detail::touched_by_sphere(map.frame(), detail::clear_m(options_, map), 0));
}

VANTAGE_INLINE bool GroundRobot::admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const VoxelFrame& frame = map.frame();
  const Eigen::Vector3d a = from.translation();
  const Eigen::Vector3d b = to.translation();
  const double radius_m = detail::clear_m(options_, map);
  if (!frame.addressable(a) || !frame.addressable(b) || frame.cell_of(a).z != frame.cell_of(b).z ||
      detail::disc_is_larger_than_known(map, radius_m)) {
    return false;
  }
  const std::int32_t layer = frame.cell_of(a).z;
  return detail::swept_sphere_is_clear(
      frame, a, b, radius_m,
      [&](const VoxelIndex& cell) { return map.is_clear(cell) || detail::sphere_touches(frame, a, radius_m, cell); },
      {layer, layer + 1});
}

VANTAGE_INLINE Pose GroundRobot::facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const {
  return pose_looking_level(position_m, direction);
}

VANTAGE_INLINE double GroundRobot::distance_m(const Pose& from, const Pose& to) const {
  return (to.translation() - from.translation()).norm();
}

VANTAGE_INLINE std::optional<std::vector<Pose>> GroundRobot::path(const OccupancyMap& map, const Pose& from,
                                                                  const Pose& to) const {
  return grid_path(map, *this, from, to);
}

VANTAGE_INLINE Box GroundRobot::body_box(const Pose& pose) const {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(std::max(reach_m(), 1e-9));
  return {pose.translation() - reach, pose.translation() + reach};
}

}  // namespace vantage
