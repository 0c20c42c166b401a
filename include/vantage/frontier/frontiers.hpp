// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_clusters.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The frontier cells of one brick, given by its address in units of bricks. A frontier cell is free, inside the
/// region of the map, and has an unknown face neighbour inside the region. The result depends only on the brick and
/// its six neighbours. (Shade & Newman 2011, VI; Dornhege & Kleiner 2011, IV-A.)
[[nodiscard]] BrickPlane frontier_plane(const OccupancyMap& map, const VoxelIndex& brick);

/// All frontier cells of the map, in raster order (z, then y, then x).
[[nodiscard]] std::vector<VoxelIndex> frontier_cells(const OccupancyMap& map);

/// The frontier cells of the map of a host (any OccupancyLookup) with `region` as its region, in raster order. It
/// asks for the cells of the region only, each up to seven times; the map of vantage is faster.
template <OccupancyLookup Lookup>
[[nodiscard]] std::vector<VoxelIndex> frontier_cells(const Lookup& lookup, const VoxelBox& region) {
  std::vector<VoxelIndex> cells;
  for_each_cell(region, [&](const VoxelIndex& cell) {
    if (lookup.at(cell) == Occupancy::Free &&
        std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& by) {
          return region.contains(cell + by) && lookup.at(cell + by) == Occupancy::Unknown;
        })) {
      cells.push_back(cell);
    }
  });
  return cells;
}

/// The number of frontier cells of the map.
[[nodiscard]] std::size_t count_frontier_cells(const OccupancyMap& map);

/// Groups frontier cells into connected clusters: cells in raster order within a cluster, clusters ordered by their
/// first cell.
[[nodiscard]] std::vector<std::vector<VoxelIndex>> frontier_clusters(
    const std::vector<VoxelIndex>& cells, Connectivity connectivity = Connectivity::Corner26);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/frontiers.ipp>
#endif
