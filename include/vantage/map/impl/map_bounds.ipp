// SPDX-License-Identifier: MIT
#pragma once

// The box around the known cells. It grows with every write. It may shrink only if a cell at its border becomes
// unknown; then it is searched for at the next write of many cells.
#include <algorithm>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/geometry/impl/box_around.hpp>

namespace vantage {

VANTAGE_INLINE VoxelBox OccupancyMap::box_of_known() const {
  constexpr std::int32_t kFar = kFurthestVoxel;
  VoxelBox bounds{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
    const auto holds = [&](const VoxelIndex& from, std::int32_t edge) {
      return bounds.contains(from) && bounds.contains(from + VoxelIndex{edge - 1, edge - 1, edge - 1});
    };
    const VoxelIndex first = Brick::first_cell(address);
    if (holds(first, Brick::kSide)) {
      return;
    }
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      if (holds(first + Brick::cell_at(64 * word), Brick::kSide / 2)) {
        continue;
      }
      for_each_offset(brick.known[word], word, [&](std::size_t offset) {
        const VoxelIndex cell = first + Brick::cell_at(offset);
        bounds.lo = {std::min(bounds.lo.x, cell.x), std::min(bounds.lo.y, cell.y), std::min(bounds.lo.z, cell.z)};
        bounds.hi = {std::max(bounds.hi.x, cell.x + 1), std::max(bounds.hi.y, cell.y + 1),
                     std::max(bounds.hi.z, cell.z + 1)};
      });
    }
  });
  return bounds.empty() ? VoxelBox{} : bounds;
}

VANTAGE_INLINE void OccupancyMap::grow_bounds(const VoxelBox& cells) { bounds_ = detail::box_around(bounds_, cells); }

VANTAGE_INLINE void OccupancyMap::grow_bounds(const VoxelIndex& address, const Brick& brick) {
  const VoxelIndex first = Brick::first_cell(address);
  if (bounds_.contains(first) && bounds_.contains(first + VoxelIndex{7, 7, 7})) {
    return;
  }
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    const std::uint64_t known = brick.known[word];
    if (known == 0) {
      continue;
    }
    // The layers of the sub-brick that hold a known cell, for each axis.
    VoxelBox layers{{4, 4, 4}, {0, 0, 0}};
    for (std::int32_t i = 0; i < 4; ++i) {
      const auto take = [i](bool holds, std::int32_t& lo, std::int32_t& hi) {
        lo = holds ? std::min(lo, i) : lo;
        hi = holds ? i + 1 : hi;
      };
      take((known & 0x1111111111111111ULL << i) != 0, layers.lo.x, layers.hi.x);
      take((known & 0x000F000F000F000FULL << 4 * i) != 0, layers.lo.y, layers.hi.y);
      take((known & 0x000000000000FFFFULL << 16 * i) != 0, layers.lo.z, layers.hi.z);
    }
    const VoxelIndex corner = first + Brick::cell_at(64 * word);
    grow_bounds({corner + layers.lo, corner + layers.hi});
  }
}

}  // namespace vantage
