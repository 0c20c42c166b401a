// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel_clusters.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The frontier cells of one brick (its address in units of bricks): free, inside the region of the map, and with an
/// unknown face neighbour inside the region (Shade & Newman 2011, VI; Dornhege & Kleiner 2011, IV-A). Depends on the
/// brick and its six neighbours alone.
[[nodiscard]] BrickPlane frontier_plane(const OccupancyMap& map, const VoxelIndex& brick);

/// All frontier cells of the map, in raster order (z, then y, then x).
[[nodiscard]] std::vector<VoxelIndex> frontier_cells(const OccupancyMap& map);

/// How many frontier cells the map has.
[[nodiscard]] std::size_t count_frontier_cells(const OccupancyMap& map);

/// The connected clusters of frontier cells: cells in raster order within a cluster, clusters by their first cells.
[[nodiscard]] std::vector<std::vector<VoxelIndex>> frontier_clusters(
    const std::vector<VoxelIndex>& cells, Connectivity connectivity = Connectivity::Corner26);

}  // namespace vantage
