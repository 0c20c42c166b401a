// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vantage/map/brick.hpp>
#include <vector>

#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage::detail {

/// Whether a plane holds the cell at this offset, see Brick::offset_of.
inline bool has(const BrickPlane& plane, std::size_t offset) {
  return (plane[offset >> 6U] >> (offset & 63U) & 1U) != 0;
}

/// The bit layout of a sub-brick (4 x 4 x 4 cells, x fastest) along one axis. Cells at coordinate 3 lie `3 * stride`
/// bits above those at coordinate 0.
struct Axis {
  std::uint64_t first;   ///< cells at coordinate 0
  unsigned stride;       ///< bits between neighbours along the axis
  std::size_t word_bit;  ///< the bit of the word number that selects the upper half of the brick
};
inline constexpr std::array<Axis, 3> kAxes{
    {{0x1111111111111111ULL, 1, 1}, {0x000F000F000F000FULL, 4, 2}, {0x000000000000FFFFULL, 16, 4}}};

/// For every cell of word `word` of `plane`: the bit of its lower neighbour along `axis`. `below` is the plane of the
/// adjacent lower brick. `from_above` is the same for the upper neighbour.
inline std::uint64_t from_below(const BrickPlane& plane, const BrickPlane& below, const Axis& axis,
                                std::size_t word) {
  const std::size_t other = word ^ axis.word_bit;
  const std::uint64_t neighbour = (word & axis.word_bit) != 0 ? plane[other] : below[other];
  return (plane[word] << axis.stride & ~axis.first) | (neighbour >> (3 * axis.stride) & axis.first);
}

inline std::uint64_t from_above(const BrickPlane& plane, const BrickPlane& above, const Axis& axis,
                                std::size_t word) {
  const std::uint64_t last = axis.first << (3 * axis.stride);
  const std::size_t other = word ^ axis.word_bit;
  const std::uint64_t neighbour = (word & axis.word_bit) == 0 ? plane[other] : above[other];
  return (plane[word] >> axis.stride & ~last) | (neighbour << (3 * axis.stride) & last);
}

/// Whether a plane has a set bit.
inline bool any(const BrickPlane& plane) {
  return std::any_of(plane.begin(), plane.end(), [](std::uint64_t word) { return word != 0; });
}

/// The cells of a brick that lie in a box.
inline BrickPlane plane_of(const VoxelIndex& brick, const VoxelBox& box) {
  const VoxelBox inside = box_overlap(Brick::cells_of(brick), box);
  const auto layers = [](const Axis& axis, std::int32_t from, std::int32_t to) {
    std::uint64_t cells = 0;
    for (std::int32_t at = std::max(from, 0); at < std::min(to, 4); ++at) {
      cells |= axis.first << (static_cast<unsigned>(at) * axis.stride);
    }
    return cells;
  };
  BrickPlane plane{};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    const VoxelIndex start = Brick::cell_at(brick, 64 * word);
    plane[word] = layers(kAxes[0], inside.lo.x - start.x, inside.hi.x - start.x) &
                  layers(kAxes[1], inside.lo.y - start.y, inside.hi.y - start.y) &
                  layers(kAxes[2], inside.lo.z - start.z, inside.hi.z - start.z);
  }
  return plane;
}

/// Whether a plane of a brick holds a cell of a box.
inline bool overlaps(const BrickPlane& plane, const VoxelIndex& brick, const VoxelBox& box) {
  const BrickPlane inside = plane_of(brick, box);
  return std::inner_product(plane.begin(), plane.end(), inside.begin(), std::uint64_t{0}, std::bit_or<>(),
                            std::bit_and<>()) != 0;
}

/// A plane dilated by one cell in both directions along an axis, within the brick.
inline BrickPlane grown_along(const BrickPlane& plane, const Axis& axis) {
  constexpr BrickPlane kOutside{};
  BrickPlane grown = plane;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    grown[word] |= from_below(plane, kOutside, axis, word) | from_above(plane, kOutside, axis, word);
  }
  return grown;
}

/// A plane dilated by the face neighbours of its cells, within the brick.
inline BrickPlane grown_through_faces(const BrickPlane& plane) {
  BrickPlane grown = plane;
  for (const Axis& axis : kAxes) {
    const BrickPlane along = grown_along(plane, axis);
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      grown[word] |= along[word];
    }
  }
  return grown;
}

/// Calls `take(piece)` for each connected piece of a plane, in the order of its first cell. `grow(piece)` adds the
/// neighbours of its cells.
template <class Grow, class Take>
void for_each_piece(const BrickPlane& plane, Grow&& grow, Take&& take) {
  for (BrickPlane left = plane; any(left);) {
    const auto first = static_cast<std::size_t>(
        std::find_if(left.begin(), left.end(), [](std::uint64_t word) { return word != 0; }) - left.begin());
    BrickPlane piece{};
    piece[first] = left[first] & (~left[first] + 1);
    for (BrickPlane before{}; piece != before;) {
      before = piece;
      piece = grow(piece);
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        piece[word] &= left[word];
      }
    }
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      left[word] &= ~piece[word];
    }
    take(piece);
  }
}

/// The number of set bits of a word. (Where the target has no instruction for it, std::popcount is a call. Most words
/// of a plane are empty or full.)
inline std::size_t bits_in(std::uint64_t word) {
  return word == 0 ? 0U : word == ~std::uint64_t{0} ? 64U : static_cast<std::size_t>(std::popcount(word));
}

/// The number of set bits of a plane.
inline std::size_t size_of(const BrickPlane& plane) {
  std::size_t count = 0;
  for (const std::uint64_t word : plane) {
    count += bits_in(word);
  }
  return count;
}

/// Appends the cells of a brick's plane to a list.
inline void append(const BrickPlane& plane, const VoxelIndex& brick, std::vector<VoxelIndex>& cells) {
  for_each_offset(plane, [&](std::size_t offset) { cells.push_back(Brick::cell_at(brick, offset)); });
}

}  // namespace vantage::detail
