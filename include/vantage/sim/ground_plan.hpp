// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/sim/triangle_mesh.hpp>

namespace VANTAGE_EXPORT vantage {

/// A floor plan as pixels, solid or free: the world of a robot that drives in one plane (read_nav2_map).
/// World::from_plan calls `validate`.
struct GroundPlan {
  double pixel_m = 0.05;  ///< edge of a pixel, metres, > 0
  double x_m = 0.0;       ///< world x of the lower left corner of pixel (0, 0), metres
  double y_m = 0.0;       ///< world y of that corner, metres
  double yaw_rad = 0.0;   ///< angle from the world's x axis to that of the pixels, counter-clockwise
  /// Pixels (x, y, 0) with (0, 0) at the lower left; nonzero is solid. Everything outside is solid.
  VoxelGrid<std::uint8_t> solid = {};

  /// Throws std::invalid_argument with the field, its value and the rule. The pixels must be one layer that starts
  /// at (0, 0, 0), with at least one free pixel.
  void validate() const;
  /// `world_from_pixels`, both in metres.
  [[nodiscard]] Pose world_from_plan() const;
  /// The smallest box that holds every pixel, world frame, metres; from z = 0, one pixel high.
  [[nodiscard]] Box bounds() const;
  /// Whether the open rectangle x, y of `box` overlaps a solid pixel or the outside. Overlaps of less than a
  /// millionth of a pixel count as rounding.
  [[nodiscard]] bool touches_solid(const Box& box) const;
  /// The borders between solid and free pixels as upright walls, z from -10 m to 10 m. Each is moved a hundredth
  /// of a pixel into its solid pixel, so that a ray that ends on it ends within a solid pixel.
  [[nodiscard]] TriangleMesh walls() const;
};

/// The sensor of a robot that drives, restricted to its plane: one level row of rays with as many columns as
/// `sensor` has. Other rays would leave the plane.
[[nodiscard]] RangeSensor in_plane(const RangeSensor& sensor);

}  // namespace vantage
