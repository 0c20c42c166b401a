// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// The smallest box that contains all `cells`; empty if there are none.
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

/// The smallest box that contains both boxes. An empty box is ignored.
[[nodiscard]] inline VoxelBox box_around(const VoxelBox& a, const VoxelBox& b) {
  if (a.empty() || b.empty()) {
    return a.empty() ? b : a;
  }
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

/// Boxes that hold all that lies within a range of these cells: one for the cells of each cube of 32 cells.
[[nodiscard]] inline std::vector<VoxelBox> boxes_around(std::span<const VoxelIndex> cells, std::int32_t range) {
  constexpr std::int32_t kCubeBits = 5;
  std::map<VoxelIndex, VoxelBox, RasterOrder> boxes;
  for (const VoxelIndex& cell : cells) {
    VoxelBox& box = boxes[{cell.x >> kCubeBits, cell.y >> kCubeBits, cell.z >> kCubeBits}];
    box = box_around(box, {cell, cell + VoxelIndex{1, 1, 1}});
  }
  std::vector<VoxelBox> grown;
  grown.reserve(boxes.size());
  for (const auto& [cube, box] : boxes) {
    grown.push_back(box.grown(range));
  }
  return grown;
}

}  // namespace vantage::detail
