// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vantage/map/brick_set.hpp>

namespace vantage::detail {

/// The cells that a search has visited: fast where each cell is near the one before.
class VisitedCells {
 public:
  /// Adds a cell. Returns whether it is new.
  bool insert(const VoxelIndex& cell) {
    if (const VoxelIndex brick = Brick::of_cell(cell); plane_ == nullptr || brick != brick_) {
      brick_ = brick;
      plane_ = &cells_.plane(brick);
    }
    const std::size_t offset = Brick::offset_of(cell);
    const std::uint64_t bit = std::uint64_t{1} << (offset & 63U);
    return (std::exchange((*plane_)[offset >> 6U], (*plane_)[offset >> 6U] | bit) & bit) == 0;
  }

 private:
  BrickSet cells_;
  VoxelIndex brick_;
  BrickPlane* plane_ = nullptr;
};

}  // namespace vantage::detail
