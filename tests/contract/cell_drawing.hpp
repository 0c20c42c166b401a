// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/scan.hpp>
#include <vantage/raytrace/range_sensor.hpp>

namespace vantage::testing {

/// Whole numbers of one seed, the same with every standard library.
class WholeNumbers {
 public:
  explicit WholeNumbers(std::uint32_t seed) : engine_(seed) {}

  /// A number in [lo, hi].
  [[nodiscard]] std::int32_t operator()(std::int32_t lo, std::int32_t hi) {
    return lo + static_cast<std::int32_t>(engine_() % static_cast<std::uint32_t>(hi - lo + 1));
  }

 private:
  std::mt19937 engine_;
};

/// Sets the cells of a box, as far as the grid has them.
inline void fill_cells(VoxelGrid<std::uint8_t>& grid, const VoxelBox& box, std::uint8_t value) {
  for_each_cell(box, [&](const VoxelIndex& cell) {
    if (grid.contains(cell)) {
      grid[cell] = value;
    }
  });
}

/// Closes a grid with a border one cell thick; a flat one has no floor and no ceiling.
inline void close_border(VoxelGrid<std::uint8_t>& grid) {
  const VoxelIndex last = grid.box().hi - VoxelIndex{1, 1, 1};
  const bool flat = grid.box().extent().z == 1;
  for_each_cell(grid.box(), [&](const VoxelIndex& c) {
    const VoxelIndex& first = grid.box().lo;
    if (c.x == first.x || c.y == first.y || c.x == last.x || c.y == last.y ||
        (!flat && (c.z == first.z || c.z == last.z))) {
      grid[c] = 1;
    }
  });
}

/// A range just inside a box that a ray of length 1 meets.
[[nodiscard]] inline double range_into(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  double entry_m = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(ray[axis]) > 1e-12) {
      entry_m = std::max(
          entry_m, std::min((box.min[axis] - origin[axis]) / ray[axis], (box.max[axis] - origin[axis]) / ray[axis]));
    }
  }
  return entry_m + 1e-4;
}

/// Adds what a ray of the sensor measures that meets a surface at `range_m`.
inline void add_ray(Scan& scan, const RangeSensor& sensor, const Eigen::Vector3f& direction, double range_m) {
  if (range_m >= sensor.min_range_m && range_m <= sensor.max_range_m) {
    scan.points.emplace_back(direction * static_cast<float>(range_m));
  } else if (range_m > sensor.max_range_m && sensor.reports_no_return) {
    scan.no_return.push_back(direction);
  }
}

}  // namespace vantage::testing
