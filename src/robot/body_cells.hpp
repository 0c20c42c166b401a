// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include "robot/swept_sphere.hpp"

namespace vantage::detail {

/// What a sphere at the centre of cell (0, 0, 0) touches.
[[nodiscard]] inline std::vector<VoxelIndex> touched_by_sphere(const VoxelFrame& frame, double radius_m) {
  const auto rings = static_cast<std::int32_t>(std::ceil(radius_m / frame.size_m));
  std::vector<VoxelIndex> touched;
  for_each_cell(VoxelBox{{0, 0, 0}, {1, 1, 1}}.grown(rings), [&](const VoxelIndex& cell) {
    if (sphere_touches(frame, frame.centre_of({0, 0, 0}), radius_m, cell)) {
      touched.push_back(cell);
    }
  });
  return touched;
}

/// The cells of `box`, as 1, at whose centre a body touches clear cells only: those at `touched` from its own.
[[nodiscard]] VoxelGrid<std::uint8_t> cells_for_body(const OccupancyMap& map, const VoxelBox& box,
                                                     const std::vector<VoxelIndex>& touched);

}  // namespace vantage::detail
