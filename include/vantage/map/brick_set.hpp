// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <deque>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A sparse set of cells: one bit per cell, stored in bricks. Memory grows with the number of bricks that were
/// written to, not with the bounding box.
class BrickSet {
 public:
  /// An empty set.
  BrickSet() = default;
  /// A set of these cells.
  explicit BrickSet(std::span<const VoxelIndex> cells) {
    for (const VoxelIndex& cell : cells) {
      insert(cell);
    }
  }

  /// Whether the set holds a cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const {
    const BrickPlane* plane = find(Brick::of_cell(cell));
    const std::size_t offset = Brick::offset_of(cell);
    return plane != nullptr && ((*plane)[offset >> 6U] >> (offset & 63U) & 1U) != 0;
  }
  /// Adds a cell.
  void insert(const VoxelIndex& cell) {
    const std::size_t offset = Brick::offset_of(cell);
    plane(Brick::of_cell(cell))[offset >> 6U] |= std::uint64_t{1} << (offset & 63U);
  }
  /// The cells of a brick as a bit plane, or null if the brick was never written to. Valid while the set lives.
  [[nodiscard]] const BrickPlane* find(const VoxelIndex& brick) const {
    const BrickDirectory::Number number = directory_.find(brick);
    return number == BrickDirectory::kNone ? nullptr : &bricks_[number].cells;
  }
  /// The cells of a brick as a bit plane, to write to. Stores the brick if necessary. Valid while the set lives.
  [[nodiscard]] BrickPlane& plane(const VoxelIndex& brick) {
    BrickDirectory::Number& number = directory_.place(brick);
    if (number == BrickDirectory::kNone) {
      number = static_cast<BrickDirectory::Number>(bricks_.size());
      bricks_.push_back({brick, {}});
    }
    return bricks_[number].cells;
  }
  /// Replaces the cells of a brick by `cells`. Returns whether the set has changed.
  bool assign(const VoxelIndex& brick, const BrickPlane& cells) {
    const BrickPlane* known = find(brick);
    if (known == nullptr ? cells == BrickPlane{} : cells == *known) {
      return false;
    }
    plane(brick) = cells;
    return true;
  }
  /// Calls `visit(brick address, const BrickPlane&)` for every brick that was written to, in order of the first
  /// write.
  template <class Visit>
  void for_each_brick(Visit&& visit) const {
    for (const Stored& stored : bricks_) {
      visit(stored.address, stored.cells);
    }
  }
  /// The cells, brick by brick in order of the first write.
  [[nodiscard]] std::vector<VoxelIndex> cells() const {
    std::vector<VoxelIndex> cells;
    for (const Stored& stored : bricks_) {
      for_each_offset(stored.cells,
                      [&](std::size_t offset) { cells.push_back(Brick::cell_at(stored.address, offset)); });
    }
    return cells;
  }
  /// The number of cells in the set.
  [[nodiscard]] std::size_t size() const {
    std::size_t count = 0;
    for (const Stored& stored : bricks_) {
      for (const std::uint64_t word : stored.cells) {
        count += static_cast<std::size_t>(std::popcount(word));
      }
    }
    return count;
  }

 private:
  struct Stored {
    VoxelIndex address;
    BrickPlane cells;
  };

  BrickDirectory directory_;
  std::deque<Stored> bricks_;
};

}  // namespace vantage
