// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vantage/compiler.hpp>
#include <vantage/map/brick.hpp>
#include <vantage/map/brick_directory.hpp>

namespace VANTAGE_EXPORT vantage {

/// A value of type T for every cell of unbounded space, stored in bricks of 8 x 8 x 8 cells. Use it instead of
/// VoxelGrid when no small box contains the cells. Memory grows with the number of bricks that were written to.
template <class T>
class BrickGrid {
 public:
  /// The values of one brick, indexed by Brick::offset_of.
  using Values = std::array<T, Brick::kCells>;

  /// Creates a grid in which every cell has `value`.
  explicit BrickGrid(const T& value = T{}) : value_(value) {}

  /// The value of a cell; the default value where its brick is not stored.
  [[nodiscard]] const T& operator[](const VoxelIndex& cell) const {
    const BrickDirectory::Number number = directory_.find(Brick::of_cell(cell));
    return number == BrickDirectory::kNone ? value_ : bricks_[number].values[Brick::offset_of(cell)];
  }
  /// The value of a cell, to write to. Stores its brick if necessary.
  [[nodiscard]] T& operator[](const VoxelIndex& cell) {
    return bricks_[store(Brick::of_cell(cell))].values[Brick::offset_of(cell)];
  }
  /// The number of a brick. Stores the brick if necessary. Numbers count up from 0.
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
  /// The number of a brick, or BrickDirectory::kNone if it is not stored.
  [[nodiscard]] BrickDirectory::Number number_of(const VoxelIndex& brick) const { return directory_.find(brick); }
  /// The number of stored bricks.
  [[nodiscard]] std::size_t bricks() const { return bricks_.size(); }
  /// The values of a stored brick, to write to. `number` must be less than `bricks()`.
  [[nodiscard]] Values& values(std::size_t number) { return bricks_[number].values; }
  /// The values of a stored brick. `number` must be less than `bricks()`.
  [[nodiscard]] const Values& values(std::size_t number) const { return bricks_[number].values; }
  /// The address of a stored brick, in units of bricks.
  [[nodiscard]] const VoxelIndex& address(std::size_t number) const { return bricks_[number].address; }

  /// Writes cells one after the other and caches the last brick. Stores bricks as necessary. A writer must not
  /// outlive the grid.
  class Writer {
   public:
    /// Writes to `grid`.
    explicit Writer(BrickGrid& grid) : grid_(&grid) {}
    /// The value of a cell, to write to.
    [[nodiscard]] T& operator()(const VoxelIndex& cell) {
      const VoxelIndex brick = Brick::of_cell(cell);
      if (brick != brick_ || values_ == nullptr) {
        brick_ = brick;
        values_ = &grid_->values(grid_->store(brick));
      }
      return (*values_)[Brick::offset_of(cell)];
    }

   private:
    BrickGrid* grid_;
    VoxelIndex brick_;
    Values* values_ = nullptr;
  };

  /// Reads cells one after the other and caches the last brick, so lookups of neighbours are fast. A reader must not
  /// outlive the grid. Do not use it after a brick was stored.
  class Reader {
   public:
    /// Reads from `grid`.
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
