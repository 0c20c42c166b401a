// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/field/laplace_domain.hpp>
#include <vector>

#include "field/aligned_vector.hpp"

namespace vantage::detail {

/// Cells of one colour in a brick: red are those of even x + y + z, black the others.
inline constexpr std::size_t kHalfBrick = 512;
/// Rows of a brick along x; each holds eight cells of either colour.
inline constexpr std::size_t kBrickRows = 64;
/// Blocks of 2 x 2 x 2 cells in a brick: 8 along x, 4 along y and z.
inline constexpr std::size_t kBrickBlocks = 128;
/// Colours of cells.
inline constexpr std::size_t kRed = 0;
inline constexpr std::size_t kBlack = 1;
/// What four bits say of a cell.
inline constexpr std::uint32_t kDegree = 7;
inline constexpr std::uint32_t kBesideSink = 8;

/// Position of a cell among those of its colour in a brick, by its row and its place in the row.
[[nodiscard]] inline std::size_t half_offset(std::size_t row, std::size_t x) { return row * 8 + x / 2; }
[[nodiscard]] inline std::size_t colour_of(std::size_t row, std::size_t x) { return (row ^ row >> 3U ^ x) & 1U; }

/// The 7-point operator over the cells of a domain, sinks held at 0: A u = degree * u - the sum of the neighbours,
/// where degree is the number of open faces and u is stored as 0 wherever there is no unknown.
///
/// Cells of a brick are stored by colour, x, then y, then z within one. Bricks are numbered from 1; brick 0 is empty
/// and stands in for those that are not there.
struct FineLevel {
  std::size_t brick_count = 0;                      ///< the empty one included
  std::vector<VoxelIndex> address;                  ///< of each brick, in units of bricks
  std::vector<std::array<std::uint32_t, 6>> links;  ///< numbers of the neighbouring bricks
  std::vector<std::uint32_t> ready;                 ///< the highest among a brick's own number and its neighbours'
  /// For each row by colour, four bits per cell: the number of open faces, 0 where there is no unknown, and
  /// kBesideSink.
  std::array<AlignedVector<std::uint32_t>, 2> faces;
  AlignedVector<std::uint32_t> blocks;  ///< the operator of the blocks, see BlockLevel
  std::size_t unknowns = 0;

  /// Open faces of a cell.
  [[nodiscard]] std::uint32_t degree(std::size_t colour, std::size_t brick, std::size_t offset) const {
    return faces[colour][brick * kBrickRows + offset / 8] >> (4 * (offset % 8)) & kDegree;
  }
  [[nodiscard]] std::size_t memory_bytes() const;
};

/// Cells of a domain without isolated ones; its bricks keep their order.
[[nodiscard]] FineLevel make_fine_level(const LaplaceDomain& domain);

/// Calls `first` for every brick in order, `second` for each as soon as `first` has passed it and its neighbours, and
/// `third` likewise after `second`: what one has written is still in the cache when the next reads it.
template <class First, class Second, class Third>
void in_waves(const FineLevel& fine, First&& first, Second&& second, Third&& third) {
  std::size_t b = 1;
  std::size_t c = 1;
  for (std::size_t a = 1; a < fine.brick_count; ++a) {
    first(a);
    for (; b <= a && fine.ready[b] <= a; ++b) {
      second(b);
    }
    for (; c < b && fine.ready[c] < b; ++c) {
      third(c);
    }
  }
}

}  // namespace vantage::detail
