// SPDX-License-Identifier: MIT
#include "robot/body_cells.hpp"

#include <algorithm>
#include <cstdlib>

namespace vantage::detail {
namespace {

// The clear cells of a box, as 1.
VoxelGrid<std::uint8_t> clear_cells_of(const OccupancyMap& map, const VoxelBox& box) {
  VoxelGrid<std::uint8_t> clear(box);
  map.for_each_clear([&](const VoxelIndex& cell) {
    if (box.contains(cell)) {
      clear[cell] = 1;
    }
  });
  return clear;
}

bool has_clear_neighbour(const VoxelGrid<std::uint8_t>& clear, const VoxelIndex& cell) {
  return std::any_of(kAllNeighbours.begin(), kAllNeighbours.end(),
                     [&](const VoxelIndex& step) { return clear.value_or(cell + step, 0) != 0; });
}

std::int32_t reach_of(const std::vector<VoxelIndex>& touched) {
  std::int32_t reach = 0;
  for (const VoxelIndex& cell : touched) {
    reach = std::max({reach, std::abs(cell.x), std::abs(cell.y), std::abs(cell.z)});
  }
  return reach;
}

}  // namespace

VoxelGrid<std::uint8_t> cells_for_body(const OccupancyMap& map, const VoxelBox& box,
                                       const std::vector<VoxelIndex>& touched) {
  const VoxelGrid<std::uint8_t> clear = clear_cells_of(map, box.grown(reach_of(touched)));
  VoxelGrid<std::uint8_t> fits(box);
  for_each_cell(box, [&](const VoxelIndex& cell) { fits[cell] = clear[cell]; });
  for_each_cell(clear.box(), [&](const VoxelIndex& cell) {
    // Deep inside what is not clear there is no centre left to forbid.
    if (clear[cell] != 0 || !has_clear_neighbour(clear, cell)) {
      return;
    }
    for (const VoxelIndex& offset : touched) {
      if (box.contains(cell - offset)) {
        fits[cell - offset] = 0;
      }
    }
  });
  return fits;
}

}  // namespace vantage::detail
