// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include <vantage/robot/impl/swept_sphere.hpp>

namespace vantage::detail {

/// How far from the sensor all cells of the map must be clear for a round body with these options, metres. Without a
/// margin at least a cell, because a free cell may contain a part of a wall.
template <class Options>
[[nodiscard]] double clear_m(const Options& options, const OccupancyMap& map) {
  return options.margin_m ? options.radius_m + *options.margin_m : std::max(options.radius_m, map.resolution_m());
}

/// The same for any body in the box `body`, on each side of its centre along each axis, as if without a margin.
[[nodiscard]] inline Eigen::Vector3d clear_half_m(const Box& body, const OccupancyMap& map) {
  return (0.5 * body.extent()).cwiseMax(map.resolution_m());
}

/// Whether a sphere touches more cells than the map has stored, so that it fits nowhere. This check bounds the cost
/// of a large body.
[[nodiscard]] inline bool is_larger_than_known(const OccupancyMap& map, double radius_m) {
  const double cells = 4.0 / 3.0 * std::numbers::pi * std::pow(radius_m / map.resolution_m(), 3.0);
  return cells > static_cast<double>(map.brick_count() * Brick::kCells);
}

/// Whether a disc touches more cells than the map has stored in one layer, of which each brick has at most 64 cells.
[[nodiscard]] inline bool disc_is_larger_than_known(const OccupancyMap& map, double radius_m) {
  const double cells = std::numbers::pi * std::pow(radius_m / map.resolution_m(), 2.0);
  return cells > static_cast<double>(map.brick_count() * 64);
}

/// The cells that a sphere at the centre of cell (0, 0, 0) touches, in layers at most `layers` away.
[[nodiscard]] inline std::vector<VoxelIndex> touched_by_sphere(const VoxelFrame& frame, double radius_m,
                                                               std::int32_t layers = kFurthestVoxel) {
  const std::int32_t rings = frame.cells_up_to(radius_m);
  VoxelBox around = VoxelBox{{0, 0, 0}, {1, 1, 1}}.grown(rings);
  around.lo.z = std::max(around.lo.z, -layers);
  around.hi.z = std::min(around.hi.z, layers + 1);
  std::vector<VoxelIndex> touched;
  for_each_cell(around, [&](const VoxelIndex& cell) {
    if (sphere_touches(frame, frame.centre_of({0, 0, 0}), radius_m, cell)) {
      touched.push_back(cell);
    }
  });
  return touched;
}

/// The cells of `box`, as 1, at whose centre a body touches clear cells only. `touched`: the cells that the body
/// touches, relative to its own.
[[nodiscard]] VoxelGrid<std::uint8_t> cells_for_body(const OccupancyMap& map, const VoxelBox& box,
                                                     const std::vector<VoxelIndex>& touched);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/body_cells.ipp>
#endif
