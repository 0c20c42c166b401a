// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/occupancy.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The cells of a box that are joined to `start` through faces of admitted cells, in the order in which the flood
/// meets them; none if `start` is not admitted or not in the box. `admits(cell)` is the rule of the host: what its
/// map says about the cells of its body. It is asked once or more for a cell, and for cells of the box only.
/// ReachableSpace holds the same for a Platform, kept from scan to scan.
template <std::predicate<const VoxelIndex&> Admits>
[[nodiscard]] std::vector<VoxelIndex> reachable_cells(const VoxelIndex& start, const VoxelBox& box,
                                                      const Admits& admits) {
  std::vector<VoxelIndex> cells;
  BrickSet met;
  const auto meet = [&](const VoxelIndex& cell) {
    if (box.contains(cell) && !met.contains(cell) && admits(cell)) {
      met.insert(cell);
      cells.push_back(cell);
    }
  };
  meet(start);
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const VoxelIndex cell = cells[next];
    for (const VoxelIndex& by : kFaceNeighbours) {
      meet(cell + by);
    }
  }
  return cells;
}

/// The cells of `region` that a sensor without a body reaches in the map of a host: free cells joined to `start`.
template <OccupancyLookup Lookup>
[[nodiscard]] std::vector<VoxelIndex> reachable_cells(const Lookup& lookup, const VoxelIndex& start,
                                                      const VoxelBox& region) {
  return reachable_cells(start, region, [&](const VoxelIndex& cell) { return lookup.at(cell) == Occupancy::Free; });
}

}  // namespace vantage
