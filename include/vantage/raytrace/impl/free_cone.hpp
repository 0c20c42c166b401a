// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage {

/// Finds how far cones of rays from the sensor reach before a cell may stop one of the rays.
class FreeCone {
 public:
  /// The grid must outlive the object.
  FreeCone(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor);

  /// A distance, metres, up to which no cell stops a ray of the cone. The search ends soon after `enough_m`.
  [[nodiscard]] double free_m(const RayCone& cone, double enough_m);

 private:
  BlockingGrid::Reader reader_;
  double size_m_;
  Eigen::Vector3d origin_;  // in cells
  Eigen::Matrix3d world_from_sensor_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/free_cone.ipp>
#endif
