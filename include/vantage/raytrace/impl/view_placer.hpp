// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage::detail {

/// Transforms the rays of a view into the world frame. Each ray reaches as far as a ray of Scan::no_return. Throws
/// std::invalid_argument if the pose is not rigid or a ray is not addressable.
inline RayPlacer view_placer(const Pose& world_from_sensor, const ViewRays& rays, const VoxelFrame& frame) {
  if (!is_rigid(world_from_sensor)) {
    throw std::invalid_argument("the pose of a view must be a rotation and a translation");
  }
  const Eigen::Vector3d reach = world_from_sensor.translation().cwiseAbs().array() + 2.0 * rays.max_range_m();
  if (!frame.addressable(reach)) {
    throw std::invalid_argument("the rays of a view reach further than cells can be addressed");
  }
  return {SensorFrame(world_from_sensor), rays.max_range_m(), frame.size_m * kFurthestVoxel, frame.size_m};
}

}  // namespace vantage::detail
