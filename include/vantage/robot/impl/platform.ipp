// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/robot/platform.hpp>

namespace vantage {

VANTAGE_INLINE VoxelGrid<std::uint8_t> Platform::admitted_cells(const OccupancyMap& map, const VoxelBox& box) const {
  VoxelGrid<std::uint8_t> admitted(box);
  for_each_cell(box, [&](const VoxelIndex& cell) { admitted[cell] = admits_cell(map, cell) ? 1 : 0; });
  return admitted;
}

}  // namespace vantage
