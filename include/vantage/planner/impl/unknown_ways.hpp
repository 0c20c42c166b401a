// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

#include <vantage/planner/impl/block_ways.hpp>

namespace vantage::detail {

/// How far the unknown is from places, by ways through everything that is not known to be occupied: free and unknown
/// cells of the region, up to a distance beyond the known ones. If the box of these cells is large beside what is
/// known, only cells in known bricks and in those that touch them count, so that the cost follows the known space.
class UnknownWays {
 public:
  /// For the map as it is now. `beyond_m`: how far around the known cells unknown ones count, metres, >= 0.
  UnknownWays(const OccupancyMap& map, double beyond_m);

  /// The mean length of the ways from all unknown cells to `cell`, metres; those without a way do not count. 0 if
  /// there are none.
  [[nodiscard]] double mean_m(const VoxelIndex& cell) const;
  /// The number of pieces of space that were linked.
  [[nodiscard]] std::size_t size() const { return ways_.size(); }

 private:
  BlockWays ways_;
  std::vector<double> unknown_;  // cells, by piece
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/unknown_ways.ipp>
#endif
