// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vantage/compiler.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>

namespace VANTAGE_EXPORT vantage {

/// A value for every cell, wherever it lies, stored by bricks of 8 x 8 x 8: the counterpart of VoxelGrid for cells
/// that no box holds tightly. Memory follows the bricks that were written to.
template <class T>
class BrickGrid {
 public:
  /// The values of one brick, by Brick::offset_of.
  using Values = std::array<T, Brick::kCells>;

  /// Every cell has `value`.
  explicit BrickGrid(const T& value = T{}) : value_(value) {}

  /// The value of a cell.
  [[nodiscard]] const T& operator[](const VoxelIndex& cell) const {
    const BrickDirectory::Number number = directory_.find(Brick::of_cell(cell));
    return number == BrickDirectory::kNone ? value_ : bricks_[number].values[Brick::offset_of(cell)];
  }
  /// The value of a cell, to write to.
  [[nodiscard]] T& operator[](const VoxelIndex& cell) {
    return bricks_[store(Brick::of_cell(cell))].values[Brick::offset_of(cell)];
  }
  /// The number of a brick, stored from now on; numbers count up from 0.
  BrickDirectory::Number store(const VoxelIndex& brick) {
    BrickDirectory::Number& number = directory_.place(brick);
    if (number == BrickDirectory::kNone) {
      number = static_cast<BrickDirectory::Number>(bricks_.size());
      bricks_.emplace_back();
      bricks_.back().address = brick;
      bricks_.back().values.fill(value_);
    }
    return number;
  }
  /// The number of a brick; BrickDirectory::kNone where it is not stored.
  [[nodiscard]] BrickDirectory::Number number_of(const VoxelIndex& brick) const { return directory_.find(brick); }
  /// How many bricks are stored.
  [[nodiscard]] std::size_t bricks() const { return bricks_.size(); }
  /// The values of a stored brick.
  [[nodiscard]] Values& values(std::size_t number) { return bricks_[number].values; }
  /// The values of a stored brick.
  [[nodiscard]] const Values& values(std::size_t number) const { return bricks_[number].values; }
  /// Where a stored brick lies.
  [[nodiscard]] const VoxelIndex& address(std::size_t number) const { return bricks_[number].address; }

  /// Looks cells up one after the other; quicker where they are neighbours. Must not outlive the grid, nor be used
  /// after a brick was stored.
  class Reader {
   public:
    /// Of the cells of `grid`.
    explicit Reader(const BrickGrid& grid) : grid_(&grid) {}
    /// The value of a cell.
    [[nodiscard]] const T& operator()(const VoxelIndex& cell) {
      const VoxelIndex brick = Brick::of_cell(cell);
      if (brick != brick_ || values_ == nullptr) {
        const BrickDirectory::Number number = grid_->number_of(brick);
        if (number == BrickDirectory::kNone) {
          return grid_->value_;
        }
        brick_ = brick;
        values_ = &grid_->values(number);
      }
      return (*values_)[Brick::offset_of(cell)];
    }

   private:
    const BrickGrid* grid_;
    VoxelIndex brick_;
    const Values* values_ = nullptr;
  };

 private:
  struct Stored {
    VoxelIndex address;
    Values values;
  };

  T value_;
  BrickDirectory directory_;
  std::deque<Stored> bricks_;
};

}  // namespace vantage
