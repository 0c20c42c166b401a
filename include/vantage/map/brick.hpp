// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy.hpp>

namespace VANTAGE_EXPORT vantage {

/// One bit per cell of a brick, in the order of the planes of Brick.
using BrickPlane = std::array<std::uint64_t, 8>;

/// 8 x 8 x 8 cells of an OccupancyMap: the leaf of its directory.
///
/// Two bit planes say what every cell is, a third what it has been; one 64-bit word of a plane is a sub-brick of 4 x
/// 4 x 4 cells, x running fastest, and the eight words of a plane are the eight sub-bricks, x running fastest again.
/// The log-odds lie in the same order, in steps of OccupancyMap::log_odds_step(), 0 for an unknown cell.
struct Brick {
  static constexpr std::int32_t kSide = 8;    ///< cells along an edge
  static constexpr std::size_t kWords = 8;    ///< sub-bricks, and so words of a plane
  static constexpr std::size_t kCells = 512;  ///< cells of a brick

  BrickPlane known{};                          ///< bit plane: free or occupied
  BrickPlane occupied{};                       ///< bit plane: occupied, a subset of `once_occupied`
  BrickPlane once_occupied{};                  ///< bit plane: occupied now or before, a subset of `known`
  std::array<std::int8_t, kCells> log_odds{};  ///< in steps, by `offset_of`

  /// The brick that holds a cell.
  [[nodiscard]] static constexpr VoxelIndex of_cell(const VoxelIndex& cell) {
    return {cell.x >> 3, cell.y >> 3, cell.z >> 3};
  }
  /// The first cell of a brick.
  [[nodiscard]] static constexpr VoxelIndex first_cell(const VoxelIndex& brick) {
    return {brick.x * kSide, brick.y * kSide, brick.z * kSide};
  }
  /// Position of a cell within its brick: word * 64 + bit.
  [[nodiscard]] static constexpr std::size_t offset_of(const VoxelIndex& cell) {
    const auto x = static_cast<std::uint32_t>(cell.x);
    const auto y = static_cast<std::uint32_t>(cell.y);
    const auto z = static_cast<std::uint32_t>(cell.z);
    const std::uint32_t word = (x >> 2 & 1U) | (y >> 2 & 1U) << 1 | (z >> 2 & 1U) << 2;
    const std::uint32_t bit = (x & 3U) | (y & 3U) << 2 | (z & 3U) << 4;
    return word * 64U + bit;
  }
  /// The inverse of `offset_of`, relative to the first cell of the brick.
  [[nodiscard]] static constexpr VoxelIndex cell_at(std::size_t offset) {
    const auto o = static_cast<std::int32_t>(offset);
    return {(o & 3) | (o >> 6 & 1) << 2, (o >> 2 & 3) | (o >> 7 & 1) << 2, (o >> 4 & 3) | (o >> 8 & 1) << 2};
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
  /// The free cells of one sub-brick.
  [[nodiscard]] std::uint64_t free(std::size_t word) const { return known[word] & ~occupied[word]; }
  /// Whether the cell at an offset is free, but was occupied before.
  [[nodiscard]] bool worn(std::size_t offset) const {
    const std::size_t word = offset >> 6U;
    return ((once_occupied[word] & ~occupied[word]) >> (offset & 63U) & 1U) != 0;
  }
};

/// Calls `visit(offset)` for each set bit of `mask`, the word `word` of a plane.
template <class Visit>
void for_each_offset(std::uint64_t mask, std::size_t word, Visit&& visit) {
  for (; mask != 0; mask &= mask - 1) {
    visit(word * 64U + static_cast<std::size_t>(std::countr_zero(mask)));
  }
}

}  // namespace vantage
