// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/geometry/lattice_hull.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The convex hull of the centres of the occupied cells. Empty if they lie in one plane.
[[nodiscard]] LatticeHull occupied_hull(const OccupancyMap& map);

/// The void cells of the map in raster order (z, then y, then x). A void cell is unknown, lies inside the region, and
/// has its centre inside or on `occupied_hull`. Cells outside VoidTiles, far from everything known, are left out.
/// Empty if the hull is empty. (Dornhege & Kleiner 2011, IV-B.)
[[nodiscard]] std::vector<VoxelIndex> void_cells(const OccupancyMap& map);

/// The number of void cells of the map, counted without visiting each: the cost follows what is known and the surface
/// of the hull, not its volume.
[[nodiscard]] std::size_t count_void_cells(const OccupancyMap& map);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/void_cells.ipp>
#endif
