// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// The smallest box that holds all of `cells`; empty if there are none.
[[nodiscard]] inline VoxelBox box_around(std::span<const VoxelIndex> cells) {
  if (cells.empty()) {
    return {};
  }
  VoxelBox box{cells.front(), cells.front() + VoxelIndex{1, 1, 1}};
  for (const VoxelIndex& cell : cells) {
    box.lo = {std::min(box.lo.x, cell.x), std::min(box.lo.y, cell.y), std::min(box.lo.z, cell.z)};
    box.hi = {std::max(box.hi.x, cell.x + 1), std::max(box.hi.y, cell.y + 1), std::max(box.hi.z, cell.z + 1)};
  }
  return box;
}

}  // namespace vantage::detail
