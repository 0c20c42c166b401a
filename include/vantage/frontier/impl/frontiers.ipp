// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/map/impl/brick_plane.hpp>

namespace vantage {
namespace detail {

// Bit i is set if first + i lies in [lo, hi), for i in [0, 4).
inline unsigned row_mask(std::int32_t first, std::int32_t lo, std::int32_t hi) {
  unsigned mask = 0;
  for (std::int32_t i = 0; i < 4; ++i) {
    mask |= first + i >= lo && first + i < hi ? 1U << i : 0U;
  }
  return mask;
}

// The cells of a sub-brick that lie in `region`.
inline std::uint64_t region_mask(const VoxelBox& region, const VoxelIndex& brick, std::size_t word) {
  const VoxelIndex first = Brick::cell_at(brick, word * 64);
  const unsigned xs = row_mask(first.x, region.lo.x, region.hi.x);
  const unsigned ys = row_mask(first.y, region.lo.y, region.hi.y);
  const unsigned zs = row_mask(first.z, region.lo.z, region.hi.z);
  std::uint64_t mask = 0;
  for (unsigned row = 0; row < 16; ++row) {
    if ((ys >> (row & 3U) & 1U) != 0 && (zs >> (row >> 2U) & 1U) != 0) {
      mask |= std::uint64_t{xs} << (4 * row);
    }
  }
  return mask;
}

// The unknown cells of a brick inside the region. All cells of a brick that is not stored are unknown.
inline BrickPlane unknown_plane(const OccupancyMap& map, const VoxelIndex& address, const Brick* brick) {
  BrickPlane unknown;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    unknown[word] = brick == nullptr ? ~std::uint64_t{0} : ~brick->known[word];
    if (map.region()) {
      unknown[word] &= region_mask(*map.region(), address, word);
    }
  }
  return unknown;
}

inline BrickPlane frontier_plane_of(const OccupancyMap& map, const VoxelIndex& address, const Brick& brick) {
  BrickPlane free;
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    free[word] = brick.free(word);
  }
  if (!detail::any(free)) {
    return {};
  }
  const BrickPlane unknown = unknown_plane(map, address, &brick);
  BrickPlane beside_unknown{};
  for (std::size_t a = 0; a < detail::kAxes.size(); ++a) {
    const VoxelIndex lower = address + kFaceNeighbours[2 * a];
    const VoxelIndex upper = address + kFaceNeighbours[2 * a + 1];
    const BrickPlane below = unknown_plane(map, lower, map.find_brick(lower));
    const BrickPlane above = unknown_plane(map, upper, map.find_brick(upper));
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      beside_unknown[word] |= detail::from_below(unknown, below, detail::kAxes[a], word) |
                              detail::from_above(unknown, above, detail::kAxes[a], word);
    }
  }
  for (std::size_t word = 0; word < Brick::kWords; ++word) {
    free[word] &= beside_unknown[word];
  }
  return free;
}

}  // namespace detail

VANTAGE_INLINE BrickPlane frontier_plane(const OccupancyMap& map, const VoxelIndex& brick) {
  const Brick* stored = map.find_brick(brick);
  return stored == nullptr ? BrickPlane{} : detail::frontier_plane_of(map, brick, *stored);
}

VANTAGE_INLINE std::vector<VoxelIndex> frontier_cells(const OccupancyMap& map) {
  std::vector<VoxelIndex> cells;
  map.for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
    detail::append(detail::frontier_plane_of(map, address, brick), address, cells);
  });
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  return cells;
}

VANTAGE_INLINE std::size_t count_frontier_cells(const OccupancyMap& map) {
  std::size_t count = 0;
  map.for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
    count += detail::size_of(detail::frontier_plane_of(map, address, brick));
  });
  return count;
}

VANTAGE_INLINE std::vector<std::vector<VoxelIndex>> frontier_clusters(const std::vector<VoxelIndex>& cells,
                                                                      Connectivity connectivity) {
  return voxel_clusters(cells, connectivity);
}

}  // namespace vantage
