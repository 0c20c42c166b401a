// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <vantage/map/map_follower.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage {
namespace detail {

// Whether a brick has these log-odds, and so these states, in the cells `of`.
inline bool holds(const Brick& brick, const BrickPlane& of, const Brick& cells) {
  bool same = true;
  for (std::size_t word = 0; word < Brick::kWords && same; ++word) {
    same = ((brick.known[word] ^ cells.known[word]) & of[word]) == 0;
    for_each_offset(same ? of[word] : 0, word,
                    [&](std::size_t offset) { same = same && brick.log_odds[offset] == cells.log_odds[offset]; });
  }
  return same;
}

}  // namespace detail

// Returns the part of the box inside the region.
VANTAGE_INLINE VoxelBox MapFollower::begin(const VoxelBox& changed) {
  const VoxelBox cells = map_.writable(changed, "MapFollower::update");
  map_.begin_revision();
  return cells;
}

VANTAGE_INLINE void MapFollower::begin(const BrickSet& changed) {
  changed.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& /*cells*/) {
    OccupancyMap::require_addressable_brick(brick, "MapFollower::update");
  });
  map_.begin_revision();
}

VANTAGE_INLINE BrickPlane MapFollower::plane_of(const VoxelIndex& brick, const VoxelBox& cells) {
  return detail::plane_of(brick, cells);
}

// Writes the cells `asked` of a brick, which the host has answered with `cells`, if they differ from the map.
VANTAGE_INLINE std::size_t MapFollower::take(const VoxelIndex& brick, const BrickPlane& asked, const Brick& cells) {
  const Brick* held = map_.find_brick(brick);
  return held != nullptr && detail::holds(*held, asked, cells) ? 0 : map_.write_brick(brick, asked, cells);
}

VANTAGE_INLINE void MapFollower::put_log_odds(std::size_t offset, std::optional<double> log_odds,
                                              Brick& cells) const {
  if (log_odds && std::isnan(*log_odds)) {
    throw std::invalid_argument("MapFollower::update: the log-odds must be a number");
  }
  const std::int8_t steps = log_odds ? map_.to_steps(*log_odds) : std::int8_t{0};
  const Occupancy state = !log_odds ? Occupancy::Unknown : steps >= 0 ? Occupancy::Occupied : Occupancy::Free;
  put(offset, state, steps, cells);
}

}  // namespace vantage
