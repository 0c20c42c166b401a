// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vantage/raytrace/impl/view_placer.hpp>

namespace vantage {

VANTAGE_INLINE ViewPlacer::ViewPlacer(const Pose& world_from_sensor, const ViewRays& rays, const VoxelFrame& frame)
    : placer_{SensorFrame(world_from_sensor), rays.max_range_m(), frame.size_m * kFurthestVoxel, frame.size_m} {
  if (!is_rigid(world_from_sensor)) {
    throw std::invalid_argument("the pose of a view must be a rotation and a translation");
  }
  const Eigen::Vector3d reach = world_from_sensor.translation().cwiseAbs().array() + 2.0 * rays.max_range_m();
  if (!frame.addressable(reach)) {
    throw std::invalid_argument("the rays of a view reach further than cells can be addressed");
  }
}

}  // namespace vantage
