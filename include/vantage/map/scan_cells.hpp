// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_set>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>

namespace VANTAGE_EXPORT vantage {

/// The cells that a scan updates, each in exactly one set.
struct ScanCells {
  std::unordered_set<VoxelIndex> hit;      ///< cells that get a hit
  std::unordered_set<VoxelIndex> cleared;  ///< cells that get a miss
  ScanReport report;                       ///< ray and cell counts
};

/// Reference implementation of OccupancyMap::insert: returns the cells that the scan would update in `map`. It walks
/// one ray at a time and is slow; the fast insertion is tested against it. Errors as OccupancyMap::insert.
[[nodiscard]] ScanCells scan_cells(const Scan& scan, const OccupancyMap& map,
                                   RayPolicy policy = RayPolicy::EveryReturn);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/scan_cells.ipp>
#endif
