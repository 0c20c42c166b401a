// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/geometry/convex_hull.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The convex hull of the centres of the map's occupied cells, in units of cells: the centre of cell (x, y, z) is the
/// point (x, y, z), so the coordinates are exact.
[[nodiscard]] ConvexHull occupied_hull(const OccupancyMap& map);

/// The void cells of the map: unknown, inside its region, and with the centre inside (or on) the hull of the occupied
/// cells (Dornhege & Kleiner 2011, IV-B), in raster order (z, then y, then x). None where that hull is empty, and
/// none further from all that is known than VoidTiles tells.
[[nodiscard]] std::vector<VoxelIndex> void_cells(const OccupancyMap& map);

/// How many void cells the map has.
[[nodiscard]] std::size_t count_void_cells(const OccupancyMap& map);

}  // namespace vantage
