// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vantage/field/laplace_domain.hpp>

#include <vantage/field/impl/aligned_vector.hpp>

namespace vantage::detail {

/// Cells of one colour in a brick. Red cells have even x + y + z, black cells odd.
inline constexpr std::size_t kHalfBrick = 512;
/// The colours of cells.
inline constexpr std::size_t kRed = 0;
inline constexpr std::size_t kBlack = 1;

/// Position of a cell among the cells of its colour in a brick, given its row and x.
[[nodiscard]] inline std::size_t half_offset(std::size_t row, std::size_t x) { return row * 8 + x / 2; }
[[nodiscard]] inline std::size_t colour_of(std::size_t row, std::size_t x) { return (row ^ row >> 3U ^ x) & 1U; }

/// One number per cell of one colour, in all bricks.
template <class T>
using HalfField = AlignedVector<T>;

/// Where the value of a cell is stored.
struct CellPlace {
  std::size_t brick;  ///< number in the fine level, which counts the bricks of the domain from 1
  std::size_t colour;
  std::size_t offset;  ///< among the cells of its colour in the brick

  CellPlace(std::size_t position, std::size_t row, std::size_t x)
      : brick(position + 1), colour(colour_of(row, x)), offset(half_offset(row, x)) {}
  /// `cell` must lie in a brick of the domain.
  CellPlace(const LaplaceDomain& domain, const VoxelIndex& cell)
      : CellPlace(domain.position_of_brick(cell), LaplaceDomain::row_of(cell),
                  static_cast<std::size_t>(cell.x & 15)) {}
};

/// A solution, not yet divided by its value at the source.
struct CellValues {
  std::array<HalfField<double>, 2> u;  ///< values by colour
  double at_source = 1.0;              ///< value at the source

  /// Normalised value of a cell: 1 at the source, 0 where there is no unknown.
  [[nodiscard]] double at(const CellPlace& place) const {
    return u[place.colour][place.brick * kHalfBrick + place.offset] / at_source;
  }
  [[nodiscard]] std::size_t memory_bytes() const { return bytes_of(u[0]) + bytes_of(u[1]); }
};

}  // namespace vantage::detail
