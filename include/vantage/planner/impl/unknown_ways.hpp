// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/map/occupancy_map.hpp>

#include <vantage/planner/impl/block_ways.hpp>

namespace vantage::detail {

/// How far the unknown is from places, by ways through everything that is not known to be occupied: free and unknown
/// cells of the region, in the bricks up to a distance beyond the known cells. If the box of these bricks is large,
/// only those of them count that are known or touch a known one, in a box around the places. So the cost is bounded
/// however much is known: what lies further away is about as far from one place as from the next.
class UnknownWays {
 public:
  /// For the map as it is now, which must not change in the lifetime of this. `beyond_m`: how far around the known
  /// cells unknown ones count, metres, >= 0. `places`: the cells that will be asked for.
  UnknownWays(const OccupancyMap& map, double beyond_m, std::span<const VoxelIndex> places);
  ~UnknownWays() = default;
  /// Neither copied nor moved: its ways ask it for cells.
  UnknownWays(const UnknownWays&) = delete;
  UnknownWays(UnknownWays&&) = delete;
  UnknownWays& operator=(const UnknownWays&) = delete;
  UnknownWays& operator=(UnknownWays&&) = delete;

  /// The mean length of the ways from all unknown cells to `cell`, metres; those without a way do not count. 0 if
  /// there are none.
  [[nodiscard]] double mean_m(const VoxelIndex& cell) const;
  /// The number of pieces of space that the ways so far have met.
  [[nodiscard]] std::size_t size() const { return ways_.size(); }

 private:
  [[nodiscard]] BrickPlane open_cells(const VoxelIndex& brick) const;
  [[nodiscard]] bool is_near_known(const VoxelIndex& brick) const;

  const OccupancyMap* map_;
  VoxelBox bricks_;
  bool all_ = true;  // all bricks of the box count
  BlockWays ways_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/unknown_ways.ipp>
#endif
