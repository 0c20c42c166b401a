// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/frontier/void_tiles.hpp>
#include <vantage/frontier/void_tracker.hpp>

#include <vantage/frontier/impl/hull_rows.hpp>
#include <vantage/geometry/impl/box_overlap.hpp>

namespace vantage {
namespace detail {

inline VoxelBox box_around_hull(const LatticeHull& hull, const OccupancyMap& map) {
  VoxelBox box = map.bounds();
  if (hull.empty()) {
    return {};
  }
  return map.region() ? detail::box_overlap(box, *map.region()) : box;
}

// Tiles grouped by rows, so that each row of cells is clipped with the hull once.
// keys z, y; values: ascending x
using TileRows = std::map<std::int32_t, std::map<std::int32_t, std::vector<std::int32_t>>>;

inline TileRows tile_rows(const OccupancyMap& map) {
  TileRows rows;
  const VoidTiles tiles(map);
  for (const VoxelIndex& tile : tiles.tiles()) {
    rows[tile.z][tile.y].push_back(tile.x);
  }
  for (auto& [z, ys] : rows) {
    for (auto& [y, xs] : ys) {
      std::sort(xs.begin(), xs.end());
    }
  }
  return rows;
}

template <class Visit>
void for_each_void_cell(const OccupancyMap& map, const Visit& visit) {
  constexpr std::int32_t kTile = 8 * Brick::kSide;
  const LatticeHull hull = occupied_hull(map);
  const VoxelBox box = box_around_hull(hull, map);
  if (box.empty()) {
    return;
  }
  const HullRows rows(planes_of(hull), 0);
  const HullRow whole{1.0 * box.lo.x, box.hi.x - 1.0};
  const auto visit_row = [&](std::int32_t first, std::int32_t last, std::int32_t y, std::int32_t z) {
    const Brick* brick = nullptr;
    for (std::int32_t x = first; x < last; ++x) {
      const VoxelIndex cell{x, y, z};
      if (x == first || (x & (Brick::kSide - 1)) == 0) {
        brick = map.find_brick(Brick::of_cell(cell));
      }
      if (brick == nullptr || brick->at(Brick::offset_of(cell)) == Occupancy::Unknown) {
        visit(cell);
      }
    }
  };
  for (const auto& [tile_z, ys] : tile_rows(map)) {
    for (std::int32_t z = std::max(tile_z * kTile, box.lo.z); z < std::min((tile_z + 1) * kTile, box.hi.z); ++z) {
      for (const auto& [tile_y, xs] : ys) {
        for (std::int32_t y = std::max(tile_y * kTile, box.lo.y); y < std::min((tile_y + 1) * kTile, box.hi.y); ++y) {
          const auto [first, last] = rows.within(whole, y, z).cells();
          for (const std::int32_t tile_x : xs) {
            visit_row(std::max(tile_x * kTile, first), std::min((tile_x + 1) * kTile, last), y, z);
          }
        }
      }
    }
  }
}

}  // namespace detail

VANTAGE_INLINE LatticeHull occupied_hull(const OccupancyMap& map) {
  // Only the first and the last occupied cell of a row can be corners of the hull.
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, std::int32_t>> ends;
  map.for_each_brick([&](const VoxelIndex& address, const Brick& brick) {
    for_each_offset(brick.occupied, [&](std::size_t offset) {
      const VoxelIndex cell = Brick::cell_at(address, offset);
      auto& row = ends.try_emplace({cell.z, cell.y}, cell.x, cell.x).first->second;
      row = {std::min(row.first, cell.x), std::max(row.second, cell.x)};
    });
  });
  std::vector<VoxelIndex> points;
  for (const auto& [row, xs] : ends) {
    points.push_back({xs.first, row.second, row.first});
    if (xs.second != xs.first) {
      points.push_back({xs.second, row.second, row.first});
    }
  }
  return LatticeHull(points);
}

VANTAGE_INLINE std::vector<VoxelIndex> void_cells(const OccupancyMap& map) {
  std::vector<VoxelIndex> cells;
  detail::for_each_void_cell(map, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  return cells;
}

VANTAGE_INLINE std::size_t count_void_cells(const OccupancyMap& map) { return VoidTracker(map).cell_count(); }

}  // namespace vantage
