// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A line along which a void may be looked into: `uv = (vp, dir, u)` of Dornhege & Kleiner 2011, Algorithm 1.
struct UtilityVector {
  VoxelIndex frontier;                                   ///< `vp`: the frontier cell that the line passes
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< `dir`: from a corner of the void to it, unit
  std::uint64_t utility = 0;                             ///< `u`: of the void, in cells
};

/// The first loop of Algorithm 1: lines from the seven corners of every void (Ellipsoid::corners) through every cell
/// of its frontier, in the order of `frontier_voids`. Where these are more than `most`, only every n-th frontier cell
/// of each void has its lines, which then count n times, with the least n that keeps to it (but for one cell per
/// void). Throws std::invalid_argument unless `most` is > 0.
[[nodiscard]] std::vector<UtilityVector> utility_vectors(const VoidClusters& voids,
                                                         std::span<const FrontierVoid> frontier_voids,
                                                         const VoxelFrame& frame, std::size_t most = 1'000'000);

/// Utility accumulated by the cells of a ReachableSpace.
struct AccumulatedUtility {
  std::vector<std::uint64_t> cells;  ///< of every reachable cell, in their order, in void cells
  std::uint64_t operations = 0;      ///< cells visited along lines
};

/// The second loop of Algorithm 1: every reachable cell on the part of a line from `min_range_m` to `max_range_m`
/// beyond its frontier cell gets the utility of the line. A line ends where sight would: before the first cell that
/// is neither reachable nor clear (OccupancyMap::is_clear).
[[nodiscard]] AccumulatedUtility accumulate_utility(const OccupancyMap& map, const ReachableSpace& reachable,
                                                    std::span<const UtilityVector> vectors, double min_range_m,
                                                    double max_range_m);

}  // namespace vantage
