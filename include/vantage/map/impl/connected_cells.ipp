// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/connected_cells.hpp>

#include <algorithm>
#include <vantage/geometry/disjoint_sets.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage::detail {

inline constexpr std::array<std::size_t, 3> kStrides{1, 8,
                                                     64};  // between the numbers of neighbouring bricks of a tile

// Whether a brick is the last one of its tile along an axis.
inline bool is_last(std::size_t brick, std::size_t axis) { return (brick / kStrides[axis] & 7U) == 7; }

// Whether a brick has a cell at its upper end along an axis.
inline bool reaches_up(const BrickPlane& cells, const Axis& axis) {
  bool found = false;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    found = found || ((word & axis.word_bit) != 0 && (cells[word] >> (3 * axis.stride) & axis.first) != 0);
  }
  return found;
}

// Whether a brick has a cell at its lower end along an axis.
inline bool reaches_down(const BrickPlane& cells, const Axis& axis) {
  bool found = false;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    found = found || ((word & axis.word_bit) == 0 && (cells[word] & axis.first) != 0);
  }
  return found;
}

// Whether a cell at the upper end of a brick along an axis has a neighbour in the next brick.
inline bool touch(const BrickPlane& lower, const BrickPlane& upper, const Axis& axis) {
  bool found = false;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    if ((word & axis.word_bit) != 0) {
      found = found || (lower[word] >> (3 * axis.stride) & upper[word ^ axis.word_bit] & axis.first) != 0;
    }
  }
  return found;
}

// Calls `take(part, part)` for the parts of two bricks that touch. `upper` lies beside `lower` along the axis.
template <class Take>
void ConnectedCells::for_each_touching(const Tile& tile, std::size_t lower, const Tile& next, std::size_t upper,
                                       std::size_t axis, Take&& take) {
  for (std::size_t a = tile.first[lower]; a < tile.first[lower + 1]; ++a) {
    if (reaches_up(tile.parts[a].cells, kAxes[axis])) {
      for (std::size_t b = next.first[upper]; b < next.first[upper + 1]; ++b) {
        if (touch(tile.parts[a].cells, next.parts[b].cells, kAxes[axis])) {
          take(a, b);
        }
      }
    }
  }
}

VANTAGE_INLINE void ConnectedCells::changed(const VoxelIndex& tile) {
  if (const Number* number = numbers_.find(tile)) {
    tiles_[*number].is_stale = true;
  }
}

VANTAGE_INLINE ConnectedCells::Number ConnectedCells::fresh_tile(const VoxelIndex& address, const Fill& fill) {
  const Number number = numbers_.place(address, static_cast<Number>(tiles_.size()));
  if (number == tiles_.size()) {
    tiles_.push_back({.address = address});
  }
  if (tiles_[number].is_stale) {
    find_groups(tiles_[number], fill);
  }
  return number;
}

VANTAGE_INLINE void ConnectedCells::find_groups(Tile& tile, const Fill& fill) {
  constexpr BrickPlane kNothing{};
  BrickPlane all;
  all.fill(~std::uint64_t{0});
  filled_.assign(kBricks, kNothing);
  fill(tile.address, filled_);
  tile.parts.clear();
  for (std::size_t brick = 0; brick < kBricks; ++brick) {
    if (filled_[brick] == all) {
      tile.parts.push_back({all, 0});
    } else if (filled_[brick] != kNothing) {
      for_each_piece(filled_[brick], grown_through_faces, [&](const BrickPlane& part) {
        tile.parts.push_back({part, 0});
      });
    }
    tile.first[brick + 1] = static_cast<std::uint32_t>(tile.parts.size());
  }
  DisjointSets sets(tile.parts.size());
  tile.opens.fill(false);
  for (std::size_t axis = 0; axis < kStrides.size(); ++axis) {
    for (std::size_t brick = 0; brick < kBricks; ++brick) {
      if (is_last(brick, axis)) {
        tile.opens[2 * axis + 1] = tile.opens[2 * axis + 1] || reaches_up(filled_[brick], kAxes[axis]);
        const BrickPlane& first = filled_[brick - 7 * kStrides[axis]];
        tile.opens[2 * axis] = tile.opens[2 * axis] || reaches_down(first, kAxes[axis]);
      } else {
        for_each_touching(tile, brick, tile, brick + kStrides[axis], axis,
                          [&](std::size_t a, std::size_t b) { sets.merge(a, b); });
      }
    }
  }
  const std::vector<std::size_t> labels = sets.labels();
  for (std::size_t part = 0; part < labels.size(); ++part) {
    tile.parts[part].group = static_cast<std::uint32_t>(labels[part]);
  }
  tile.groups = static_cast<std::uint32_t>(sets.count());
  ++tile.version;
  tile.is_stale = false;
  tile.is_new = true;
}

// The links from a tile to the next one along an axis; both have groups.
VANTAGE_INLINE const ConnectedCells::Links& ConnectedCells::fresh_links(Tile& tile, const Tile& next,
                                                                        std::size_t axis) {
  Links& links = tile.links[axis];
  if (links.here == tile.version && links.there == next.version) {
    return links;
  }
  links.here = tile.version;
  links.there = next.version;
  links.groups.clear();
  for (std::size_t brick = 0; brick < kBricks; ++brick) {
    if (is_last(brick, axis)) {
      for_each_touching(tile, brick, next, brick - 7 * kStrides[axis], axis, [&](std::size_t a, std::size_t b) {
        links.groups.emplace_back(tile.parts[a].group, next.parts[b].group);
      });
    }
  }
  std::sort(links.groups.begin(), links.groups.end());
  links.groups.erase(std::unique(links.groups.begin(), links.groups.end()), links.groups.end());
  return links;
}

VANTAGE_INLINE void ConnectedCells::reach(const Group& group) {
  Tile& tile = tiles_[group.tile];
  if (tile.reached.empty()) {
    tile.reached.resize(tile.groups);
    reached_.push_back(group.tile);
  }
  if (!tile.reached[group.group]) {
    tile.reached[group.group] = true;
    open_.push_back(group);
  }
}

VANTAGE_INLINE void ConnectedCells::search(std::span<const VoxelIndex> starts, const Fill& fill) {
  for (const VoxelIndex& start : starts) {
    const VoxelIndex brick = Brick::of_cell(start);
    const Number number = fresh_tile(Brick::of_cell(brick), fill);
    const Tile& tile = tiles_[number];
    const std::size_t at = in_tile(brick);
    const std::size_t offset = Brick::offset_of(start);
    for (std::size_t part = tile.first[at]; part < tile.first[at + 1]; ++part) {
      if (has(tile.parts[part].cells, offset)) {
        reach({number, tile.parts[part].group});
      }
    }
  }
  while (!open_.empty()) {
    const Group from = open_.back();
    open_.pop_back();
    for (std::size_t way = 0; way < kFaceNeighbours.size(); ++way) {
      if (!tiles_[from.tile].opens[way]) {
        continue;
      }
      const std::size_t axis = way / 2;
      const Number beside = fresh_tile(tiles_[from.tile].address + kFaceNeighbours[way], fill);
      const bool up = way % 2 == 1;
      Tile& lower = tiles_[up ? from.tile : beside];
      const Tile& upper = tiles_[up ? beside : from.tile];
      for (const auto& [below, above] : fresh_links(lower, upper, axis).groups) {
        if ((up ? below : above) == from.group) {
          reach({beside, up ? above : below});
        }
      }
    }
  }
}

}  // namespace vantage::detail
