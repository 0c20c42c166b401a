// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/unknown_ways.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage::detail {

// Ways are long where they count, so blocks may be large.
inline constexpr std::int32_t kBlockSide = 8;
inline constexpr double kFurthestM = 1e3;
// A box of more bricks is large, if it holds more than so many for each known one.
inline constexpr double kManyBricks = 20'000.0;
inline constexpr double kPerKnownBrick = 8.0;

// The cells of a brick inside `box` that are not known to be occupied.
inline BrickPlane open_cells(const OccupancyMap& map, const VoxelIndex& address, const VoxelBox& box) {
  const Brick* const brick = map.find_brick(address);
  const VoxelIndex first = Brick::first_cell(address);
  const bool inside = box.contains(first) && box.contains(first + VoxelIndex{7, 7, 7});
  BrickPlane open;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    open[word] = brick == nullptr ? ~std::uint64_t{0} : ~brick->occupied[word];
    std::uint64_t outside = 0;
    for_each_offset(inside ? 0 : open[word], word, [&](std::size_t offset) {
      const bool is_in = box.contains(first + Brick::cell_at(offset));
      outside |= std::uint64_t{!is_in} << (offset & 63U);
    });
    open[word] &= ~outside;
  }
  return open;
}

// The bricks of the box; only the known ones and those that touch them, if the box is large beside these.
inline std::vector<VoxelIndex> bricks_in(const OccupancyMap& map, const VoxelBox& bricks) {
  std::vector<VoxelIndex> found;
  if (static_cast<double>(bricks.size()) <=
      std::max(kManyBricks, kPerKnownBrick * static_cast<double>(map.brick_count()))) {
    for_each_cell(bricks, [&](const VoxelIndex& brick) { found.push_back(brick); });
    return found;
  }
  map.for_each_brick([&](const VoxelIndex& address, const Brick&) {
    for_each_cell(VoxelBox{address, address + VoxelIndex{1, 1, 1}}.grown(1), [&](const VoxelIndex& brick) {
      if (bricks.contains(brick)) {
        found.push_back(brick);
      }
    });
  });
  std::sort(found.begin(), found.end(), RasterOrder{});
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

VANTAGE_INLINE UnknownWays::UnknownWays(const OccupancyMap& map, double beyond_m) : ways_(map.frame(), kBlockSide) {
  VoxelBox box = map.bounds().grown(map.frame().cells_up_to(std::min(beyond_m, kFurthestM)));
  box = map.region() ? box_overlap(box, *map.region()) : box;
  const VoxelBox bricks{Brick::of_cell(box.lo), Brick::of_cell(box.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}};
  for (const VoxelIndex& brick : bricks_in(map, bricks)) {
    ways_.add(brick, open_cells(map, brick, box));
  }
  ways_.link();
  for (BlockWays::Piece piece = 0; piece < ways_.size(); ++piece) {
    const Brick* const brick = map.find_brick(ways_.brick_of(piece));
    int cells = 0;
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      cells += std::popcount(ways_.cells_of(piece)[word] & ~(brick == nullptr ? 0 : brick->known[word]));
    }
    unknown_.push_back(cells);
  }
}

VANTAGE_INLINE double UnknownWays::mean_m(const VoxelIndex& cell) const {
  const std::vector<double> lengths = ways_.lengths_from(cell);
  double sum = 0.0;
  double cells = 0.0;
  for (std::size_t piece = 0; piece < lengths.size(); ++piece) {
    if (lengths[piece] != BlockWays::kNoWay) {
      sum += unknown_[piece] * lengths[piece];
      cells += unknown_[piece];
    }
  }
  return cells > 0.0 ? sum / cells : 0.0;
}

}  // namespace vantage::detail
