// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>

namespace VANTAGE_EXPORT vantage {

/// Parameters of OccupancyMap: the beam model of Shade & Newman 2011, eq. 11-13, with the clamping of OctoMap.
struct OccupancyMapOptions {
  double resolution_m = 0.1;    ///< edge length of a cell, > 0
  double log_odds_hit = 0.85;   ///< added to the cell in which a ray ends, > 0 (S&N VI: l_occ)
  double log_odds_miss = -0.4;  ///< added to the cells that a ray passes, < 0 (S&N VI: l_free)
  double log_odds_min = -2.0;   ///< lower clamp, < 0
  double log_odds_max = 3.5;    ///< upper clamp, > 0; a cell with log-odds >= 0 is occupied, as in OctoMap
  /// only cells whose centre lies inside can become known; nullopt: no limit
  std::optional<Box> region = std::nullopt;
  /// Whether a scan must not erase surfaces that it sees at a grazing angle. If true, rays do not clear an occupied
  /// cell that touches the end cell of a return, nor the unbroken run of occupied cells at the end of a ray. Reason:
  /// a surface fills only a part of its cells, and rays at a grazing angle pass the free part. If all of them count
  /// (false, as in OctoMap), they erase the surface and open false frontiers behind it.
  bool keep_grazed_cells = true;
  /// Largest distance from the sensor, metres, > 0, from which a ray clears an occupied cell, between the cells'
  /// centres; needs `keep_grazed_cells`. The further away a surface is, the smaller the angle at which rays meet it,
  /// so more of its cells lie along rays that pass. What has gone away is cleared once the sensor comes near.
  double erase_range_m = 3.0;
  /// Most bytes that the map may use, as counted by `memory_bytes`; 0: no limit. An update that would need a new
  /// brick beyond the limit is refused and counted (ScanReport::cells_refused, OccupancyMap::cells_refused), and its
  /// cell stays unknown. Existing bricks are still updated. The work space of a scan comes on top: at most 1 GB.
  std::size_t max_bytes = 0;

  /// Options that reproduce `octomap::OcTree::insertPointCloud` update for update.
  [[nodiscard]] static OccupancyMapOptions octomap(double resolution_m) {
    return {.resolution_m = resolution_m, .keep_grazed_cells = false};
  }
};

}  // namespace vantage
