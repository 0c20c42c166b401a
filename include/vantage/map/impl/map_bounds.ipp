// SPDX-License-Identifier: MIT
#pragma once

// The box around the known cells. It grows with every write. It may shrink only if a cell at its border becomes
// unknown; then it is searched for at the next write of many cells.
#include <algorithm>
#include <initializer_list>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage {
namespace detail {

// The box around the cells of a word of a brick whose first cell is `corner`; empty if there are none.
inline VoxelBox box_of_word(const VoxelIndex& corner, std::uint64_t cells) {
  VoxelBox layers{{4, 4, 4}, {0, 0, 0}};  // those that hold a cell, for each axis
  for (std::int32_t i = 0; i < 4; ++i) {
    const auto take = [i](bool holds, std::int32_t& lo, std::int32_t& hi) {
      lo = holds ? std::min(lo, i) : lo;
      hi = holds ? i + 1 : hi;
    };
    take((cells & 0x1111111111111111ULL << i) != 0, layers.lo.x, layers.hi.x);
    take((cells & 0x000F000F000F000FULL << 4 * i) != 0, layers.lo.y, layers.hi.y);
    take((cells & 0x000000000000FFFFULL << 16 * i) != 0, layers.lo.z, layers.hi.z);
  }
  return {corner + layers.lo, corner + layers.hi};
}

// The box around a box and the known cells of a brick.
inline VoxelBox box_around_known(VoxelBox box, const VoxelIndex& address, const Brick& brick) {
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    box = box_around(box, box_of_word(Brick::cell_at(address, 64 * word), brick.known[word]));
  }
  return box;
}

inline bool holds_box(const VoxelBox& outer, const VoxelBox& inner) {
  return inner.empty() || box_around(outer, inner) == outer;
}

}  // namespace detail

// Looks into few bricks: first into those at the ends of the axes, because `bounds_` still holds all known cells.
VANTAGE_INLINE VoxelBox OccupancyMap::box_of_known() const {
  VoxelBox bounds;
  const auto search = [&](auto&& at_an_end) {
    for (std::size_t number = 0; number < bricks_.size(); ++number) {
      const VoxelIndex& address = entries_[number].address;
      const VoxelBox cells = detail::box_overlap(Brick::cells_of(address), bounds_);
      if (at_an_end(cells) && !detail::holds_box(bounds, cells)) {
        bounds = detail::box_around_known(bounds, address, bricks_[number]);
      }
    }
  };
  for (std::int32_t VoxelIndex::*const axis : {&VoxelIndex::x, &VoxelIndex::y, &VoxelIndex::z}) {
    search([&](const VoxelBox& cells) {
      return cells.lo.*axis == bounds_.lo.*axis || cells.hi.*axis == bounds_.hi.*axis;
    });
  }
  search([](const VoxelBox& /*cells*/) { return true; });
  return bounds;
}

VANTAGE_INLINE void OccupancyMap::grow_bounds(const VoxelBox& cells) { bounds_ = detail::box_around(bounds_, cells); }

VANTAGE_INLINE void OccupancyMap::grow_bounds(const VoxelIndex& address, const Brick& brick) {
  if (!detail::holds_box(bounds_, Brick::cells_of(address))) {
    bounds_ = detail::box_around_known(bounds_, address, brick);
  }
}

}  // namespace vantage
