// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/unknown_ways.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>
#include <vantage/map/impl/brick_plane.hpp>

namespace vantage::detail {

// Ways are long where they count, so blocks may be large.
inline constexpr std::int32_t kBlockSide = 8;
inline constexpr double kFurthestM = 1e3;
// A box of more bricks is large: a cube of 2 * 13 + 1 bricks along an edge.
inline constexpr std::int32_t kNearBricks = 13;
inline constexpr std::size_t kManyBricks = 27U * 27U * 27U;

inline VoxelBox bricks_over(const VoxelBox& cells) {
  const VoxelIndex last = Brick::of_cell(cells.hi - VoxelIndex{1, 1, 1});
  return cells.empty() ? VoxelBox{} : VoxelBox{Brick::of_cell(cells.lo), last + VoxelIndex{1, 1, 1}};
}

VANTAGE_INLINE UnknownWays::UnknownWays(const OccupancyMap& map, double beyond_m, std::span<const VoxelIndex> places)
    : map_(&map), ways_(map.frame(), kBlockSide, [this](const VoxelIndex& brick) { return open_cells(brick); }) {
  const VoxelBox box = map.bounds().grown(map.frame().cells_up_to(std::min(beyond_m, kFurthestM)));
  bricks_ = bricks_over(map.region() ? box_overlap(box, *map.region()) : box);
  all_ = bricks_.size() <= kManyBricks;
  if (!all_) {
    bricks_ = box_overlap(bricks_, bricks_over(box_around(places)).grown(kNearBricks));
  }
}

// The cells of a brick that are not known to be occupied, if the brick counts.
VANTAGE_INLINE BrickPlane UnknownWays::open_cells(const VoxelIndex& brick) const {
  if (!bricks_.contains(brick) || !(all_ || is_near_known(brick))) {
    return {};
  }
  constexpr std::uint64_t kFull = ~std::uint64_t{0};
  BrickPlane open = map_->region() ? plane_of(brick, *map_->region())
                                   : BrickPlane{kFull, kFull, kFull, kFull, kFull, kFull, kFull, kFull};
  if (const Brick* const known = map_->find_brick(brick)) {
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      open[word] &= ~known->occupied[word];
    }
  }
  return open;
}

VANTAGE_INLINE bool UnknownWays::is_near_known(const VoxelIndex& brick) const {
  bool found = false;
  for_each_cell(VoxelBox{brick, brick + VoxelIndex{1, 1, 1}}.grown(1),
                [&](const VoxelIndex& near) { found = found || map_->find_brick(near) != nullptr; });
  return found;
}

VANTAGE_INLINE double UnknownWays::mean_m(const VoxelIndex& cell) const {
  const std::vector<double> lengths = ways_.lengths_from(cell);
  double sum = 0.0;
  double cells = 0.0;
  for (BlockWays::Piece piece = 0; piece < lengths.size(); ++piece) {
    if (lengths[piece] != BlockWays::kNoWay) {
      BrickPlane unknown = ways_.cells_of(piece);
      const Brick* const known = map_->find_brick(ways_.brick_of(piece));
      for (std::size_t word = 0; known != nullptr && word < Brick::kWords; ++word) {
        unknown[word] &= ~known->known[word];
      }
      const auto count = static_cast<double>(size_of(unknown));
      sum += count * lengths[piece];
      cells += count;
    }
  }
  return cells > 0.0 ? sum / cells : 0.0;
}

}  // namespace vantage::detail
