// SPDX-License-Identifier: MIT
#include <cmath>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/grid_path.hpp>

#include "map/option_rule.hpp"
#include "robot/swept_sphere.hpp"

namespace vantage {
namespace {

// The clear cells of a box, as 1.
VoxelGrid<std::uint8_t> clear_cells(const OccupancyMap& map, const VoxelBox& box) {
  VoxelGrid<std::uint8_t> clear(box);
  map.for_each_clear([&](const VoxelIndex& cell) {
    if (box.contains(cell)) {
      clear[cell] = 1;
    }
  });
  return clear;
}

bool has_clear_neighbour(const VoxelGrid<std::uint8_t>& clear, const VoxelIndex& cell) {
  for (const VoxelIndex& step : kAllNeighbours) {
    if (clear.value_or(cell + step, 0) != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

FreeFlyer::FreeFlyer(const FreeFlyerOptions& options) : options_(options) {
  detail::require_option(std::isfinite(options.radius_m) && options.radius_m >= 0.0, "FreeFlyerOptions::radius_m",
                         options.radius_m, ">= 0");
  detail::require_option(std::isfinite(options.margin_m) && options.margin_m >= 0.0, "FreeFlyerOptions::margin_m",
                         options.margin_m, ">= 0");
  detail::require_option(options.min_height_m <= options.max_height_m, "FreeFlyerOptions::min_height_m",
                         options.min_height_m, "<= max_height_m");
}

bool FreeFlyer::admits(const OccupancyMap& map, const Pose& pose) const {
  const Eigen::Vector3d position = pose.translation();
  if (!is_rigid(pose) || !map.frame().addressable(position) || !height_allowed(position.z())) {
    return false;
  }
  if (options_.yaw_only && std::abs(optical_axis(pose).z()) > 1e-6) {
    return false;
  }
  return detail::swept_sphere_is_clear(map.frame(), position, position, reach_m(),
                                       [&](const VoxelIndex& cell) { return map.is_clear(cell); });
}

bool FreeFlyer::admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const {
  const Eigen::Vector3d centre = map.frame().centre_of(cell);
  return height_allowed(centre.z()) &&
         detail::swept_sphere_is_clear(map.frame(), centre, centre, reach_m(),
                                       [&](const VoxelIndex& touched) { return map.is_clear(touched); });
}

VoxelGrid<std::uint8_t> FreeFlyer::admitted_cells(const OccupancyMap& map, const VoxelBox& box) const {
  // What a sphere at the centre of cell (0, 0, 0) touches; every cell that is not clear forbids the centres around
  // it.
  const VoxelFrame& frame = map.frame();
  const VoxelBox home{{0, 0, 0}, {1, 1, 1}};
  const auto rings = static_cast<std::int32_t>(std::ceil(reach_m() / frame.size_m));
  std::vector<VoxelIndex> touched;
  for_each_cell(home.grown(rings), [&](const VoxelIndex& cell) {
    if (detail::sphere_touches(frame, frame.centre_of({0, 0, 0}), reach_m(), cell)) {
      touched.push_back(cell);
    }
  });
  const VoxelGrid<std::uint8_t> clear = clear_cells(map, box.grown(rings));
  VoxelGrid<std::uint8_t> admitted(box);
  for_each_cell(box, [&](const VoxelIndex& cell) {
    admitted[cell] = clear[cell] != 0 && height_allowed(frame.centre_of(cell).z()) ? 1 : 0;
  });
  for_each_cell(clear.box(), [&](const VoxelIndex& cell) {
    // Deep inside what is not clear there is no centre left to forbid.
    if (clear[cell] != 0 || !has_clear_neighbour(clear, cell)) {
      return;
    }
    for (const VoxelIndex& offset : touched) {
      if (box.contains(cell - offset)) {
        admitted[cell - offset] = 0;
      }
    }
  });
  return admitted;
}

bool FreeFlyer::admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  const VoxelFrame& frame = map.frame();
  const Eigen::Vector3d a = from.translation();
  const Eigen::Vector3d b = to.translation();
  if (!frame.addressable(a) || !frame.addressable(b) || !height_allowed(b.z())) {
    return false;
  }
  return detail::swept_sphere_is_clear(frame, a, b, reach_m(), [&](const VoxelIndex& cell) {
    return map.is_clear(cell) || detail::sphere_touches(frame, a, reach_m(), cell);
  });
}

Pose FreeFlyer::facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const {
  if (!options_.yaw_only) {
    return pose_looking_along(position_m, direction);
  }
  const bool has_heading = std::hypot(direction.x(), direction.y()) > 1e-9;
  return pose_looking(position_m, has_heading ? std::atan2(direction.y(), direction.x()) : 0.0);
}

double FreeFlyer::distance_m(const Pose& from, const Pose& to) const {
  return (to.translation() - from.translation()).norm();
}

std::optional<std::vector<Pose>> FreeFlyer::path(const OccupancyMap& map, const Pose& from, const Pose& to) const {
  return grid_path(map, *this, from, to);
}

Box FreeFlyer::body_box(const Pose& pose) const {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(std::max(reach_m(), 1e-9));
  return {pose.translation() - reach, pose.translation() + reach};
}

}  // namespace vantage
