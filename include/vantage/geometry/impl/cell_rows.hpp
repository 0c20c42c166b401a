// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace vantage::detail {

/// A set of cells of a box, one bit per cell, in rows of whole words along x. For operations on whole rows, and for
/// frequent lookups that should stay in the cache.
class CellRows {
 public:
  CellRows() = default;
  /// Creates an empty set of cells of `box`.
  explicit CellRows(const VoxelBox& box)
      : box_(box), words_per_row_((static_cast<std::size_t>(box.extent().x) + 63) / 64) {
    const VoxelIndex extent = box.extent();
    words_.resize(words_per_row_ * static_cast<std::size_t>(extent.y) * static_cast<std::size_t>(extent.z));
  }

  [[nodiscard]] const VoxelBox& box() const { return box_; }
  /// Adds a cell, which must be in the box.
  void insert(const VoxelIndex& cell) { words_[word_of(cell)] |= std::uint64_t{1} << bit_of(cell); }
  /// Adds up to four cells, given by the bits of `cells`, from `first` on along x. All must be in the box, and
  /// `first` must be a multiple of 4 cells from its start.
  void insert_four(const VoxelIndex& first, std::uint64_t cells) { words_[word_of(first)] |= cells << bit_of(first); }
  [[nodiscard]] bool contains(const VoxelIndex& cell) const {
    return box_.contains(cell) && (words_[word_of(cell)] >> bit_of(cell) & 1U) != 0;
  }
  /// The row (., y, z) of the box. Bit i of word w is the cell 64 w + i from the start of the row.
  [[nodiscard]] std::span<std::uint64_t> row(std::int32_t y, std::int32_t z) {
    return {words_.data() + word_of({box_.lo.x, y, z}), words_per_row_};
  }
  [[nodiscard]] std::span<const std::uint64_t> row(std::int32_t y, std::int32_t z) const {
    return {words_.data() + word_of({box_.lo.x, y, z}), words_per_row_};
  }

 private:
  [[nodiscard]] std::size_t word_of(const VoxelIndex& cell) const {
    const VoxelIndex at = cell - box_.lo;
    const auto row = static_cast<std::size_t>(at.z) * static_cast<std::size_t>(box_.hi.y - box_.lo.y) +
                     static_cast<std::size_t>(at.y);
    return row * words_per_row_ + static_cast<std::size_t>(at.x) / 64;
  }
  [[nodiscard]] std::uint32_t bit_of(const VoxelIndex& cell) const {
    return static_cast<std::uint32_t>(cell.x - box_.lo.x) & 63U;
  }

  VoxelBox box_;
  std::size_t words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
};

/// Word `at` of the row shifted by `steps`: each cell gets the value of the cell `steps` further along x. Cells
/// beyond the ends are 0.
[[nodiscard]] inline std::uint64_t shifted_word(std::span<const std::uint64_t> row, std::size_t at,
                                                std::int32_t steps) {
  const std::int64_t first = static_cast<std::int64_t>(at) * 64 + steps;
  const std::int64_t word = first >> 6;
  const auto bits = static_cast<std::uint32_t>(first & 63);
  const auto word_at = [&](std::int64_t i) {
    return i >= 0 && i < static_cast<std::int64_t>(row.size()) ? row[static_cast<std::size_t>(i)] : std::uint64_t{0};
  };
  return bits == 0 ? word_at(word) : word_at(word) >> bits | word_at(word + 1) << (64U - bits);
}

}  // namespace vantage::detail
