// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy.hpp>

namespace VANTAGE_EXPORT vantage {

/// A bit plane of a brick: one bit per cell, eight 64-bit words. Brick defines the bit order.
using BrickPlane = std::array<std::uint64_t, 8>;

/// A block of 8 x 8 x 8 cells: the unit of storage of OccupancyMap.
///
/// Three bit planes hold the state of each cell. One word of a plane is a sub-brick of 4 x 4 x 4 cells; the eight
/// words of a plane are the eight sub-bricks. Both the bits of a word and the words of a plane are ordered with x
/// fastest, then y, then z:
///
///     offset of a cell = word * 64 + bit,   word = x2 | y2 << 1 | z2 << 2,   bit = x1x0 | y1y0 << 2 | z1z0 << 4
///
/// where x2 x1 x0 are the binary digits of x within the brick. The log-odds are stored in the same order, in steps of
/// OccupancyMap::log_odds_step(); they are 0 for an unknown cell.
struct Brick {
  static constexpr std::int32_t kSide = 8;    ///< cells along an edge
  static constexpr std::size_t kWords = 8;    ///< 64-bit words of a plane (sub-bricks)
  static constexpr std::size_t kCells = 512;  ///< cells of a brick

  BrickPlane known{};                          ///< bit plane: free or occupied now
  BrickPlane occupied{};                       ///< bit plane: occupied now; a subset of `known`
  std::array<std::int8_t, kCells> log_odds{};  ///< in steps, indexed by `offset_of`

  /// The address (in units of bricks) of the brick that holds a cell.
  [[nodiscard]] static constexpr VoxelIndex of_cell(const VoxelIndex& cell) {
    return {cell.x >> 3, cell.y >> 3, cell.z >> 3};
  }
  /// The cell with the smallest coordinates in a brick.
  [[nodiscard]] static constexpr VoxelIndex first_cell(const VoxelIndex& brick) {
    return {brick.x * kSide, brick.y * kSide, brick.z * kSide};
  }
  /// The cells of the bricks of a box of addresses.
  [[nodiscard]] static constexpr VoxelBox cells_of(const VoxelBox& bricks) {
    return {first_cell(bricks.lo), first_cell(bricks.hi)};
  }
  /// The cells of a brick.
  [[nodiscard]] static constexpr VoxelBox cells_of(const VoxelIndex& brick) {
    return cells_of(VoxelBox{brick, brick + VoxelIndex{1, 1, 1}});
  }
  /// The addresses of the bricks that overlap a box of cells; empty for an empty box.
  [[nodiscard]] static constexpr VoxelBox over(const VoxelBox& cells) {
    return cells.empty() ? VoxelBox{}
                         : VoxelBox{of_cell(cells.lo), of_cell(cells.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}};
  }
  /// Position of a cell within its brick: word * 64 + bit, in [0, 512). Only the low three bits of each coordinate
  /// count. Always inline: it stands in the innermost loops, and g++ 12 calls it there.
  [[nodiscard, gnu::always_inline]] static constexpr std::size_t offset_of(const VoxelIndex& cell) {
    const auto x = static_cast<std::uint32_t>(cell.x);
    const auto y = static_cast<std::uint32_t>(cell.y);
    const auto z = static_cast<std::uint32_t>(cell.z);
    const std::uint32_t word = (x >> 2 & 1U) | (y >> 2 & 1U) << 1 | (z >> 2 & 1U) << 2;
    const std::uint32_t bit = (x & 3U) | (y & 3U) << 2 | (z & 3U) << 4;
    return word * 64U + bit;
  }
  /// The inverse of `offset_of`: the cell relative to the first cell of its brick. `offset` is in [0, 512).
  [[nodiscard]] static constexpr VoxelIndex cell_at(std::size_t offset) {
    const auto o = static_cast<std::int32_t>(offset);
    return {(o & 3) | (o >> 6 & 1) << 2, (o >> 2 & 3) | (o >> 7 & 1) << 2, (o >> 4 & 3) | (o >> 8 & 1) << 2};
  }
  /// The cell at an offset of a brick.
  [[nodiscard]] static constexpr VoxelIndex cell_at(const VoxelIndex& brick, std::size_t offset) {
    return first_cell(brick) + cell_at(offset);
  }

  /// State of the cell at an offset.
  [[nodiscard]] Occupancy at(std::size_t offset) const {
    const std::uint64_t bit = std::uint64_t{1} << (offset & 63U);
    const std::size_t word = offset >> 6U;
    if ((known[word] & bit) == 0) {
      return Occupancy::Unknown;
    }
    return (occupied[word] & bit) != 0 ? Occupancy::Occupied : Occupancy::Free;
  }
  /// Bit mask of the free cells of one sub-brick.
  [[nodiscard]] std::uint64_t free(std::size_t word) const { return known[word] & ~occupied[word]; }
  /// The free cells, as a bit plane.
  [[nodiscard]] BrickPlane free() const {
    BrickPlane cells{};
    for (std::size_t word = 0; word < kWords; ++word) {
      cells[word] = free(word);
    }
    return cells;
  }
};

/// Calls `visit(offset)` for each set bit of `mask`, which is word number `word` of a plane. Ascending order.
template <class Visit>
void for_each_offset(std::uint64_t mask, std::size_t word, Visit&& visit) {
  for (; mask != 0; mask &= mask - 1) {
    visit(word * 64U + static_cast<std::size_t>(std::countr_zero(mask)));
  }
}

/// Calls `visit(offset)` for each set bit of a plane. Ascending order.
template <class Visit>
void for_each_offset(const BrickPlane& plane, Visit&& visit) {
  for (std::size_t word = 0; word < plane.size(); ++word) {
    for_each_offset(plane[word], word, visit);
  }
}

}  // namespace vantage
