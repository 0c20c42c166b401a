// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/connected_cells.hpp>

#include <algorithm>
#include <vantage/geometry/disjoint_sets.hpp>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage::detail {

inline constexpr std::array<VoxelIndex, 3> kUnits{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
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

VANTAGE_INLINE void ConnectedCells::update(const BrickSet& cells, std::span<const VoxelIndex> changed) {
  std::vector<VoxelIndex> stale(changed.size());
  std::transform(changed.begin(), changed.end(), stale.begin(), Brick::of_cell);
  std::sort(stale.begin(), stale.end(), RasterOrder{});
  stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
  for (const VoxelIndex& address : stale) {
    const std::uint32_t number = numbers_.place(address, static_cast<std::uint32_t>(tiles_.size()));
    if (number == tiles_.size()) {
      tiles_.push_back({.address = address});
    }
    find_groups(cells, tiles_[number]);
  }
  for (const VoxelIndex& address : stale) {
    for (std::size_t axis = 0; axis < kUnits.size(); ++axis) {
      find_links(tiles_[*numbers_.find(address)], axis);
      if (const std::uint32_t* below = numbers_.find(address - kUnits[axis])) {
        find_links(tiles_[*below], axis);
      }
    }
  }
}

VANTAGE_INLINE void ConnectedCells::find_groups(const BrickSet& cells, Tile& tile) {
  tile.is_new = true;
  tile.parts.clear();
  const VoxelIndex first = Brick::first_cell(tile.address);
  for (std::size_t brick = 0; brick < kBricks; ++brick) {
    const auto at = static_cast<std::int32_t>(brick);
    if (const BrickPlane* held = cells.find(first + VoxelIndex{at & 7, at >> 3 & 7, at >> 6})) {
      for_each_piece(*held, grown_through_faces, [&](const BrickPlane& part) { tile.parts.push_back({part, 0}); });
    }
    tile.first[brick + 1] = static_cast<std::uint32_t>(tile.parts.size());
  }
  DisjointSets sets(tile.parts.size());
  for (std::size_t axis = 0; axis < kUnits.size(); ++axis) {
    for (std::size_t brick = 0; brick < kBricks; ++brick) {
      if (!is_last(brick, axis)) {
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
}

VANTAGE_INLINE void ConnectedCells::find_links(Tile& tile, std::size_t axis) {
  std::vector<Link>& links = tile.links[axis];
  links.clear();
  const std::uint32_t* number = numbers_.find(tile.address + kUnits[axis]);
  if (number == nullptr) {
    return;
  }
  const Tile& next = tiles_[*number];
  for (std::size_t brick = 0; brick < kBricks; ++brick) {
    if (is_last(brick, axis)) {
      for_each_touching(tile, brick, next, brick - 7 * kStrides[axis], axis, [&](std::size_t a, std::size_t b) {
        links.emplace_back(tile.parts[a].group, next.parts[b].group);
      });
    }
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
}

VANTAGE_INLINE std::vector<std::vector<bool>> ConnectedCells::connected_with(
    std::span<const VoxelIndex> starts) const {
  std::vector<std::size_t> first_group{0};  // of each tile, when the groups of all tiles are counted up
  for (const Tile& tile : tiles_) {
    first_group.push_back(first_group.back() + tile.groups);
  }
  DisjointSets sets(first_group.back());
  for (std::size_t number = 0; number < tiles_.size(); ++number) {
    for (std::size_t axis = 0; axis < kUnits.size(); ++axis) {
      for (const auto& [here, there] : tiles_[number].links[axis]) {
        sets.merge(first_group[number] + here,
                   first_group[*numbers_.find(tiles_[number].address + kUnits[axis])] + there);
      }
    }
  }
  std::vector<bool> is_root(first_group.back(), false);
  for (const VoxelIndex& start : starts) {
    const VoxelIndex brick = Brick::of_cell(start);
    const std::uint32_t* const number = numbers_.find(Brick::of_cell(brick));
    const auto in_tile = static_cast<std::size_t>((brick.x & 7) | (brick.y & 7) << 3 | (brick.z & 7) << 6);
    const std::size_t offset = Brick::offset_of(start);
    if (number == nullptr) {
      continue;
    }
    const Tile& tile = tiles_[*number];
    for (std::size_t part = tile.first[in_tile]; part < tile.first[in_tile + 1]; ++part) {
      if ((tile.parts[part].cells[offset >> 6U] >> (offset & 63U) & 1U) != 0) {
        is_root[sets.find(first_group[*number] + tile.parts[part].group)] = true;
      }
    }
  }
  std::vector<std::vector<bool>> connected;
  for (std::size_t number = 0; number < tiles_.size(); ++number) {
    std::vector<bool>& groups = connected.emplace_back(tiles_[number].groups);
    for (std::size_t group = 0; group < groups.size(); ++group) {
      groups[group] = is_root[sets.find(first_group[number] + group)];
    }
  }
  return connected;
}

}  // namespace vantage::detail
