// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/raytrace/range_sensor.hpp>

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
  std::mt19937 engine(seed);
  const auto draw = [&](std::int32_t lo, std::int32_t hi) {
    return lo + static_cast<std::int32_t>(engine() % static_cast<std::uint32_t>(hi - lo + 1));
  };
  const auto fill = [&](const VoxelIndex& lo, const VoxelIndex& hi, std::uint8_t value) {
    for_each_cell({lo, hi}, [&](const VoxelIndex& cell) {
      if (world.solid.contains(cell)) {
        world.solid[cell] = value;
      }
    });
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
  for_each_cell(world.solid.box(), [&](const VoxelIndex& c) {
    if (c.x == 0 || c.y == 0 || c.z == 0 || c.x == kX - 1 || c.y == kY - 1 || c.z == kZ - 1) {
      world.solid[c] = 1;
    }
  });
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
      // The point where the ray enters the cell, moved slightly inwards.
      const Box box = world.frame.box_of(cell);
      double entry = 0.0;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (std::abs(ray[axis]) > 1e-12) {
          entry = std::max(entry, std::min((box.min[axis] - origin[axis]) / ray[axis],
                                           (box.max[axis] - origin[axis]) / ray[axis]));
        }
      }
      const double range_m = entry + 1e-4;
      if (range_m >= sensor.min_range_m && range_m <= sensor.max_range_m) {
        scan.points.emplace_back(direction * static_cast<float>(range_m));
      } else if (range_m > sensor.max_range_m && sensor.reports_no_return) {
        scan.no_return.push_back(direction);
      }
      break;
    }
  }
  return scan;
}

}  // namespace vantage::testing
