// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vantage/map/brick_grid.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace vantage {

/// The cells of a ReachableSpace with consecutive numbers, for searches that store a value per cell in arrays. The
/// start has number 0.
class NumberedCells {
 public:
  /// The number of a cell that is not reachable.
  static constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

  /// Numbers the cells of `space`.
  explicit NumberedCells(const ReachableSpace& space) : cells_(space.cells()) {
    for (std::uint32_t number = 0; number < cells_.size(); ++number) {
      numbers_[cells_[number]] = number;
    }
    if (space.start()) {
      std::uint32_t& of_start = numbers_[*space.start()];
      std::swap(cells_[0], cells_[of_start]);
      std::swap(numbers_[cells_[of_start]], of_start);
    }
  }

  /// The number of cells.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// The cells by number.
  [[nodiscard]] const std::vector<VoxelIndex>& cells() const { return cells_; }
  /// The number of a cell, or kOutside.
  [[nodiscard]] std::uint32_t number_of(const VoxelIndex& cell) const { return numbers_[cell]; }

 private:
  std::vector<VoxelIndex> cells_;
  BrickGrid<std::uint32_t> numbers_{kOutside};
};

}  // namespace vantage
