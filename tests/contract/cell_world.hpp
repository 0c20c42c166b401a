// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/raytrace/range_sensor.hpp>

#include "contract/cell_drawing.hpp"

namespace vantage::testing {

/// A closed world of cells with random furniture, small enough to verify claims exhaustively.
struct CellWorld {
  VoxelFrame frame{0.2};
  VoxelGrid<std::uint8_t> solid;
  VoxelIndex start{2, 2, 2};

  [[nodiscard]] bool is_solid(const VoxelIndex& cell) const { return solid.value_or(cell, 1) != 0; }
};

enum class Furniture { Rooms, Pillars, Boxes };

[[nodiscard]] inline CellWorld make_cell_world(Furniture furniture, std::uint32_t seed) {
  constexpr std::int32_t kX = 18;
  constexpr std::int32_t kY = 14;
  constexpr std::int32_t kZ = 8;
  CellWorld world;
  world.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {kX, kY, kZ}}, 0);
  WholeNumbers draw(seed);
  const auto fill = [&](const VoxelIndex& lo, const VoxelIndex& hi, std::uint8_t value) {
    fill_cells(world.solid, {lo, hi}, value);
  };
  if (furniture == Furniture::Rooms) {
    const std::int32_t wall = draw(7, 10);
    const std::int32_t door = draw(2, 9);
    fill({wall, 0, 0}, {wall + 1, kY, kZ}, 1);
    fill({wall, door, 1}, {wall + 1, door + 3, 6}, 0);
    const std::int32_t cross = draw(5, 8);
    fill({wall + 1, cross, 0}, {kX, cross + 1, kZ}, 1);
    fill({wall + 3, cross, 1}, {wall + 6, cross + 1, 5}, 0);
  } else {
    for (int i = 0; i < 5; ++i) {
      const VoxelIndex lo{draw(5, 15), draw(1, 11), furniture == Furniture::Pillars ? 0 : draw(0, 5)};
      const VoxelIndex size{draw(1, 3), draw(1, 3), furniture == Furniture::Pillars ? kZ : draw(1, 3)};
      fill(lo, lo + size, 1);
    }
  }
  close_border(world.solid);
  fill({1, 1, 1}, {4, 4, 4}, 0);
  return world;
}

/// A simulated scan: each ray returns a point just inside the first solid cell.
[[nodiscard]] inline Scan scan_cells_of(const CellWorld& world, const RangeSensor& sensor, const Pose& pose) {
  Scan scan;
  scan.world_from_sensor = pose;
  scan.max_range_m = sensor.max_range_m;
  const Eigen::Vector3d origin = pose.translation();
  for (const Eigen::Vector3f& direction : sensor.directions()) {
    const Eigen::Vector3d ray = pose.linear() * direction.cast<double>();
    const Eigen::Vector3d end = origin + 20.0 * ray;
    for (const VoxelIndex& cell : VoxelRay(world.frame, origin, end)) {
      if (!world.is_solid(cell)) {
        continue;
      }
      add_ray(scan, sensor, direction, range_into(world.frame.box_of(cell), origin, ray));
      break;
    }
  }
  return scan;
}

}  // namespace vantage::testing
