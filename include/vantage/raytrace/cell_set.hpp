// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/brick.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A set of cells inside a box, one bit per cell: for example what a view sees of an object. A 64-bit word holds 4 x
/// 4 x 4 cells, x fastest, as in Brick. Two sets that are combined must have the same box.
class CellSet {
 public:
  CellSet() = default;
  /// Creates an empty set of cells of `box`.
  explicit CellSet(const VoxelBox& box) : box_(box) {
    if (!box.empty()) {
      lo_ = word_of(box.lo);
      extent_ = word_of(box.hi - VoxelIndex{1, 1, 1}) - lo_ + VoxelIndex{1, 1, 1};
      words_.resize(VoxelBox{{}, extent_}.size());
    }
  }

  /// The address of the word that holds a cell.
  [[nodiscard]] static VoxelIndex word_of(const VoxelIndex& cell) { return {cell.x >> 2, cell.y >> 2, cell.z >> 2}; }
  /// The bit of a cell in its word.
  [[nodiscard]] static std::uint64_t bit_of(const VoxelIndex& cell) {
    return std::uint64_t{1} << (Brick::offset_of(cell) & 63U);
  }
  /// The cells that the set can hold.
  [[nodiscard]] const VoxelBox& box() const { return box_; }
  /// Whether the set holds a cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const {
    return box_.contains(cell) && (words_[place_of(cell)] & bit_of(cell)) != 0;
  }
  /// Adds a cell. No effect outside the box.
  void insert(const VoxelIndex& cell) {
    if (box_.contains(cell)) {
      words_[place_of(cell)] |= bit_of(cell);
    }
  }
  /// Adds the cells of a word, in the layout of `for_each_word`. Cells outside the box are ignored.
  void insert_word(const VoxelIndex& word, std::uint64_t cells) {
    if (VoxelBox{lo_, lo_ + extent_}.contains(word)) {
      const VoxelIndex first{word.x * 4, word.y * 4, word.z * 4};
      const bool whole = box_.contains(first) && box_.contains(first + VoxelIndex{3, 3, 3});
      words_[place_of(first)] |= whole ? cells : cells & in_box(first);
    }
  }
  /// The cells of a word, in the layout of `for_each_word`; 0 outside the box.
  [[nodiscard]] std::uint64_t word(const VoxelIndex& word) const {
    return VoxelBox{lo_, lo_ + extent_}.contains(word) ? words_[place_of({word.x * 4, word.y * 4, word.z * 4})] : 0;
  }
  /// Removes a cell.
  void erase(const VoxelIndex& cell) {
    if (box_.contains(cell)) {
      words_[place_of(cell)] &= ~bit_of(cell);
    }
  }
  /// The number of cells in the set.
  [[nodiscard]] std::size_t size() const {
    std::size_t count = 0;
    for (const std::uint64_t word : words_) {
      count += static_cast<std::size_t>(std::popcount(word));
    }
    return count;
  }
  /// Union with a set of the same box.
  CellSet& operator|=(const CellSet& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      words_[i] |= other.words_[i];
    }
    return *this;
  }
  /// Difference: removes the cells of a set of the same box.
  CellSet& operator-=(const CellSet& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      words_[i] &= ~other.words_[i];
    }
    return *this;
  }
  /// Whether both the boxes and the cells are equal.
  friend bool operator==(const CellSet&, const CellSet&) = default;

  /// Calls `visit(VoxelIndex word, std::uint64_t cells)` for every word with a cell. Cell (x, y, z) is bit x % 4 + 4
  /// (y % 4) + 16 (z % 4) of word (x / 4, y / 4, z / 4); the divisions round down and the remainders are >= 0.
  template <class Visit>
  void for_each_word(Visit&& visit) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (words_[i] != 0) {
        visit(word_at(i), words_[i]);
      }
    }
  }
  /// Calls `visit(VoxelIndex)` for every cell, word by word.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for_each_word([&](const VoxelIndex& word, std::uint64_t left) {
      const VoxelIndex first{word.x * 4, word.y * 4, word.z * 4};
      for (; left != 0; left &= left - 1) {
        visit(first + Brick::cell_at(static_cast<std::size_t>(std::countr_zero(left))));
      }
    });
  }

 private:
  // Words are stored by z, then y, then x.
  [[nodiscard]] std::size_t place_of(const VoxelIndex& cell) const {
    const VoxelIndex at = word_of(cell) - lo_;
    return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(extent_.y) + static_cast<std::size_t>(at.y)) *
               static_cast<std::size_t>(extent_.x) +
           static_cast<std::size_t>(at.x);
  }
  // The cells inside the box of the word whose first cell is `first`.
  [[nodiscard]] std::uint64_t in_box(const VoxelIndex& first) const {
    constexpr std::uint64_t kX = 0x1111111111111111U;  // cells with x % 4 = 0
    constexpr std::uint64_t kY = 0x000F000F000F000FU;
    constexpr std::uint64_t kZ = 0x000000000000FFFFU;
    // kBelowX[n]: the cells with x % 4 < n. In the same way for y and z.
    constexpr std::array<std::uint64_t, 5> kBelowX{0, kX, kX * 3, kX * 7, ~std::uint64_t{0}};
    constexpr std::array<std::uint64_t, 5> kBelowY{0, kY, kY * 0x11, kY * 0x111, ~std::uint64_t{0}};
    constexpr std::array<std::uint64_t, 5> kBelowZ{0, kZ, kZ * 0x10001, kZ * 0x100010001, ~std::uint64_t{0}};
    const auto place = [](std::int32_t cell) { return static_cast<std::size_t>(std::clamp(cell, 0, 4)); };
    const VoxelIndex lo = box_.lo - first;
    const VoxelIndex hi = box_.hi - first;
    return kBelowX[place(hi.x)] & kBelowY[place(hi.y)] & kBelowZ[place(hi.z)] & ~kBelowX[place(lo.x)] &
           ~kBelowY[place(lo.y)] & ~kBelowZ[place(lo.z)];
  }
  [[nodiscard]] VoxelIndex word_at(std::size_t place) const {
    const auto row = static_cast<std::size_t>(extent_.x);
    const auto plane = row * static_cast<std::size_t>(extent_.y);
    return lo_ + VoxelIndex{static_cast<std::int32_t>(place % row), static_cast<std::int32_t>(place % plane / row),
                            static_cast<std::int32_t>(place / plane)};
  }

  VoxelBox box_;
  VoxelIndex lo_;
  VoxelIndex extent_;
  std::vector<std::uint64_t> words_;
};

}  // namespace vantage
