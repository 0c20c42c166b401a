// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include "planner/block_ways.hpp"

namespace vantage::detail {

/// How far the unknown is from places, by ways through everything that is not known to be occupied: free and unknown
/// cells of the region, up to a distance beyond the known ones.
class UnknownWays {
 public:
  /// For the map as it is now. `beyond_m`: how far around the known cells unknown ones count, metres, >= 0.
  UnknownWays(const OccupancyMap& map, double beyond_m);

  /// The mean length of the ways from all unknown cells to `cell`, metres; those without a way do not count. 0 if
  /// there are none.
  [[nodiscard]] double mean_m(const VoxelIndex& cell) const;

 private:
  BlockWays ways_;
  std::vector<double> unknown_;  // cells, by piece
};

}  // namespace vantage::detail
