// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>

namespace vantage {

/// A true world of whole cells and a simulated sensor: each ray returns a point inside the first occupied cell.
/// Outside the grid, everything is occupied.
struct GridWorld {
  VoxelFrame frame;
  VoxelGrid<std::uint8_t> occupied;

  [[nodiscard]] bool blocked(const VoxelIndex& cell) const { return occupied.value_or(cell, 1) != 0; }

  [[nodiscard]] Scan scan(const RangeSensor& sensor, const Pose& pose) const {
    Scan scan;
    scan.world_from_sensor = pose;
    scan.max_range_m = sensor.max_range_m;
    for (const Eigen::Vector3f& direction : sensor.directions()) {
      const Eigen::Vector3d ray = direction.cast<double>();
      const Eigen::Vector3d origin = pose.translation();
      const Eigen::Vector3d end = pose * Eigen::Vector3d(sensor.max_range_m * ray);
      bool met = false;
      for (const VoxelIndex& cell : VoxelRay(frame, origin, end)) {
        if (blocked(cell)) {
          const double range_m = enter_m(origin, (end - origin).normalized(), frame.box_of(cell));
          if (range_m >= sensor.min_range_m) {
            scan.points.push_back(((range_m + 1e-3 * frame.size_m) * ray).cast<float>());
          }
          met = true;
          break;
        }
      }
      if (!met && sensor.reports_no_return) {
        scan.no_return.push_back(direction);
      }
    }
    return scan;
  }

 private:
  static double enter_m(const Eigen::Vector3d& origin, const Eigen::Vector3d& along, const Box& box) {
    double enter = 0.0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (along[axis] != 0.0) {
        const double face = along[axis] > 0.0 ? box.min[axis] : box.max[axis];
        enter = std::max(enter, (face - origin[axis]) / along[axis]);
      }
    }
    return enter;
  }
};

}  // namespace vantage
