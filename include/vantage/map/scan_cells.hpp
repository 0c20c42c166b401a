// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_set>
#include <vantage/compiler.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>

namespace VANTAGE_EXPORT vantage {

/// The cells that a scan updates, each once: those it hits, and those its rays pass and do not hit.
struct ScanCells {
  std::unordered_set<VoxelIndex> hit;      ///< cells that become more occupied
  std::unordered_set<VoxelIndex> cleared;  ///< cells that become more free
  ScanReport report;                       ///< rays counted by what became of them
};

/// The definition of what OccupancyMap::insert would do to `map`, written to be read: one exact walk per ray, into
/// sets. Slow; it is what the fast insertion is tested against. Errors as OccupancyMap::insert.
[[nodiscard]] ScanCells scan_cells(const Scan& scan, const OccupancyMap& map,
                                   RayPolicy policy = RayPolicy::EveryReturn);

}  // namespace vantage
