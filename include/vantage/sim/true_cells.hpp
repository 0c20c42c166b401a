// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/brick.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// State of a cell of the true world.
enum class CellTruth : std::uint8_t {
  Free,    ///< no surface
  Grazed,  ///< surfaces only within 2 % of the cell's edge from its faces: rounding and a few rays decide what a map
           ///< makes of it, so either state is right; to a body and to sight it is occupied
  Occupied,  ///< a surface passes
};

/// True states of the cells of a box. Memory follows the surfaces: bricks of free cells are not stored, except for a
/// number each.
class TrueCells {
 public:
  /// An empty box.
  TrueCells() : TrueCells(VoxelBox{}) {}
  /// A box in which every cell is free.
  explicit TrueCells(const VoxelBox& box) : box_(box), numbers_(Brick::over(box), 0), bricks_(1) {}

  /// The cells that have a state.
  [[nodiscard]] const VoxelBox& box() const { return box_; }
  /// Whether a cell has a state.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return box_.contains(cell); }
  /// The state of a cell; free outside of the box.
  [[nodiscard]] CellTruth operator[](const VoxelIndex& cell) const {
    return contains(cell) ? bricks_[numbers_[Brick::of_cell(cell)]][Brick::offset_of(cell)] : CellTruth::Free;
  }
  /// Whether all cells of a brick that overlaps the box are free.
  [[nodiscard]] bool is_free_brick(const VoxelIndex& brick) const { return numbers_[brick] == 0; }
  /// Sets the state of a cell of the box.
  void set(const VoxelIndex& cell, CellTruth state) {
    std::uint32_t& number = numbers_[Brick::of_cell(cell)];
    if (number == 0 && state != CellTruth::Free) {
      number = static_cast<std::uint32_t>(bricks_.size());
      bricks_.emplace_back();
    }
    if (number != 0) {
      bricks_[number][Brick::offset_of(cell)] = state;
    }
  }

 private:
  VoxelBox box_;
  VoxelGrid<std::uint32_t> numbers_;                          // by brick; 0: only free cells
  std::vector<std::array<CellTruth, Brick::kCells>> bricks_;  // the first one is free
};

}  // namespace vantage
