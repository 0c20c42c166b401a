// SPDX-License-Identifier: MIT
#pragma once

// Writes many cells of one brick at once. Each function has the effect of OccupancyMap::write on every cell.
#include <bit>
#include <stdexcept>
#include <string>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage {
VANTAGE_INLINE void OccupancyMap::require_addressable_brick(const VoxelIndex& brick, const char* what) {
  constexpr std::int32_t kFurthestBrick = kFurthestVoxel >> 3;
  const auto near = [](std::int32_t i) { return i >= -kFurthestBrick && i <= kFurthestBrick; };
  if (!near(brick.x) || !near(brick.y) || !near(brick.z)) {
    throw std::invalid_argument(std::string(what) + ": brick (" + std::to_string(brick.x) + ", " +
                                std::to_string(brick.y) + ", " + std::to_string(brick.z) +
                                ") cannot be addressed, must be within " + std::to_string(kFurthestBrick) +
                                " on each axis");
  }
}

// The cells of a brick that are inside the region.
VANTAGE_INLINE BrickPlane OccupancyMap::in_region(const VoxelIndex& brick, BrickPlane cells) const {
  if (region_) {
    const BrickPlane inside = detail::plane_of(brick, *region_);
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      cells[word] &= inside[word];
    }
  }
  return cells;
}

VANTAGE_INLINE void OccupancyMap::assign(const VoxelIndex& brick, const BrickPlane& known,
                                         const BrickPlane& occupied) {
  require_addressable_brick(brick, "OccupancyMap::assign");
  Brick cells{known, occupied, {}};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    if ((occupied[word] & ~known[word]) != 0) {
      throw std::invalid_argument("OccupancyMap::assign: every cell of `occupied` must be in `known`");
    }
    for (std::size_t i = 0; i < 64; ++i) {
      const std::int8_t steps = (occupied[word] >> i & 1U) != 0 ? max_steps_ : min_steps_;
      cells.log_odds[64 * word + i] = (known[word] >> i & 1U) != 0 ? steps : std::int8_t{0};
    }
  }
  BrickPlane all;
  all.fill(~std::uint64_t{0});
  const BrickPlane which = in_region(brick, all);
  if (!detail::any(which)) {
    return;
  }
  ++revision_;
  write_brick(brick, which, cells);
  const BrickDirectory::Number number = directory_.find(brick);
  if (number != BrickDirectory::kNone && which == all && known == all && !detail::any(occupied)) {
    bricks_.share(number);
  }
}

// Writes the cells `which` of a brick, which must be inside the region, as they are in `cells`. Returns how many have
// changed their state.
VANTAGE_INLINE std::size_t OccupancyMap::write_brick(const VoxelIndex& address, const BrickPlane& which,
                                                     const Brick& cells) {
  std::size_t known = 0;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    known += detail::bits_in(cells.known[word] & which[word]);
  }
  if (known == 0 && directory_.find(address) == BrickDirectory::kNone) {
    return 0;
  }
  const BrickDirectory::Number number = brick_for(address);
  if (number == BrickDirectory::kNone) {
    cells_refused_ += known;
    return 0;
  }
  Brick& brick = writing(number);
  std::size_t changed = 0;
  std::uint64_t any_new = 0;
  BrickPlane gone{};
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    const std::uint64_t of = which[word];
    const std::uint64_t old = brick.known[word];
    const std::uint64_t occupied = (brick.occupied[word] & ~of) | (cells.occupied[word] & of);
    brick.known[word] = (old & ~of) | (cells.known[word] & of);
    changed += detail::bits_in((old ^ brick.known[word]) | (brick.occupied[word] ^ occupied));
    brick.occupied[word] = occupied;
    any_new |= brick.known[word] & ~old;
    gone[word] = old & ~brick.known[word];
    for_each_offset(of, word, [&](std::size_t offset) { brick.log_odds[offset] = cells.log_odds[offset]; });
  }
  if (changed > 0) {
    mark_changed(number);
    note_unknown(address, gone);
    if (any_new != 0) {
      grow_bounds(address, brick);
    }
  }
  return changed;
}

// Notes that these cells of a brick have become unknown, before the bounds grow: the bounds may have shrunk if one of
// them lies at their border.
VANTAGE_INLINE void OccupancyMap::note_unknown(const VoxelIndex& address, const BrickPlane& cells) {
  const VoxelBox inner = bounds_.grown(-1);
  const VoxelIndex first = Brick::first_cell(address);
  if (inner.contains(first) && inner.contains(first + VoxelIndex{7, 7, 7})) {
    return;
  }
  for (std::size_t word = 0; word < Brick::kWords && !may_have_shrunk_; ++word) {
    for_each_offset(cells[word], word, [&](std::size_t offset) {
      may_have_shrunk_ = may_have_shrunk_ || !inner.contains(first + Brick::cell_at(offset));
    });
  }
}

}  // namespace vantage
