// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage::detail {

/// Tells for any box of cells whether some of a set may lie in it, in one look at each of its corners: sums over
/// blocks of 8 x 8 x 8 cells (a summed area table, Crow 1984).
class BlockCounts {
 public:
  /// Of these cells, all of them in `box`.
  BlockCounts(const VoxelBox& box, std::span<const VoxelIndex> cells)
      : sums_({block_of(box.lo), block_of(box.hi) + VoxelIndex{2, 2, 2}}) {
    constexpr VoxelIndex kOne{1, 1, 1};
    for (const VoxelIndex& cell : cells) {
      ++sums_[block_of(cell) + kOne];
    }
    for (const VoxelIndex& step : {VoxelIndex{1, 0, 0}, VoxelIndex{0, 1, 0}, VoxelIndex{0, 0, 1}}) {
      for_each_cell(sums_.box(), [&](const VoxelIndex& block) { sums_[block] += sums_.value_or(block - step, 0); });
    }
  }

  /// False only if none lies in this box.
  [[nodiscard]] bool may_hold(const VoxelBox& cells) const {
    if (cells.empty()) {
      return false;
    }
    // A sum holds the blocks below it on every axis.
    const VoxelIndex lo = clamped(block_of(cells.lo));
    const VoxelIndex hi = clamped(block_of(cells.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1});
    const auto sum = [&](std::int32_t x, std::int32_t y, std::int32_t z) { return sums_[{x, y, z}]; };
    return sum(hi.x, hi.y, hi.z) - sum(lo.x, hi.y, hi.z) - sum(hi.x, lo.y, hi.z) + sum(lo.x, lo.y, hi.z) !=
           sum(hi.x, hi.y, lo.z) - sum(lo.x, hi.y, lo.z) - sum(hi.x, lo.y, lo.z) + sum(lo.x, lo.y, lo.z);
  }

 private:
  static VoxelIndex block_of(const VoxelIndex& cell) { return {cell.x >> 3, cell.y >> 3, cell.z >> 3}; }
  [[nodiscard]] VoxelIndex clamped(const VoxelIndex& block) const {
    const VoxelBox& box = sums_.box();
    return {std::clamp(block.x, box.lo.x, box.hi.x - 1), std::clamp(block.y, box.lo.y, box.hi.y - 1),
            std::clamp(block.z, box.lo.z, box.hi.z - 1)};
  }

  VoxelGrid<std::uint32_t> sums_;
};

}  // namespace vantage::detail
