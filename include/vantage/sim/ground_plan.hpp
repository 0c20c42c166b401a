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

/// A floor as pixels, solid or free: the world of a robot that drives in one plane (a nav2 map, read_nav2_map).
/// Aggregate; `validate` is called once by everything that takes one.
struct GroundPlan {
  double pixel_m = 0.05;  ///< edge of a pixel, metres, > 0
  double x_m = 0.0;       ///< where the lower left corner of pixel (0, 0) lies in the world
  double y_m = 0.0;       ///< see `x_m`
  double yaw_rad = 0.0;   ///< from the world's x axis to the pixels', counter-clockwise
  /// Pixels (x, y, 0), (0, 0) the lowest left one; nonzero is solid. Outside of them all is solid.
  VoxelGrid<std::uint8_t> solid = {};

  /// Throws std::invalid_argument naming the field, its value and the rule; the pixels are one layer from (0, 0, 0)
  /// on, and at least one is free.
  void validate() const;
  /// `world_from_pixels`, both in metres.
  [[nodiscard]] Pose world_from_plan() const;
  /// The smallest box that holds every pixel; as high as a pixel, from z = 0.
  [[nodiscard]] Box bounds() const;
  /// Whether the open rectangle that is x and y of `box` holds a part of a solid pixel, or of what is outside.
  /// Overlaps of less than a millionth of a pixel are let pass as rounding.
  [[nodiscard]] bool touches_solid(const Box& box) const;
  /// The borders between solid and free pixels as upright walls, z from -10 m to 10 m, each moved a hundredth of a
  /// pixel into its solid pixel, so that a ray that ends on one ends within a solid pixel.
  [[nodiscard]] TriangleMesh walls() const;
};

/// A sensor of a robot that drives, in the plane of its own layer of cells: one row of rays, level, of as many
/// columns as the sensor has. Rays that leave the plane would tell nothing of it.
[[nodiscard]] RangeSensor in_plane(const RangeSensor& sensor);

}  // namespace vantage
