// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A ray along which a sensor may look into a void: `uv = (vp, dir, u)` of Dornhege & Kleiner 2011, Algorithm 1.
struct UtilityVector {
  VoxelIndex frontier;  ///< `vp`: the frontier cell that the ray passes
  /// `dir`: unit direction from a corner of the void to the frontier cell
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  std::uint64_t utility = 0;  ///< `u`: utility of the void in cells, times the stride (see utility_vectors)
};

/// First loop of Algorithm 1: casts a ray from the seven corners of every void (Ellipsoid::corners) through every
/// cell of its frontier, in the order of `frontier_voids`. If there are more than `most` rays, only every n-th
/// frontier cell of each void is used and its utility is multiplied by n. n is the smallest stride that meets the
/// limit, except that every void keeps at least one cell. Throws std::invalid_argument if `most` is 0.
[[nodiscard]] std::vector<UtilityVector> utility_vectors(const VoidClusters& voids,
                                                         std::span<const FrontierVoid> frontier_voids,
                                                         const VoxelFrame& frame, std::size_t most = 1'000'000);

/// Accumulated utility of cells of a ReachableSpace.
struct AccumulatedUtility {
  /// The reachable cells with a utility above 0, in raster order, and their utility in void cells.
  std::vector<std::pair<VoxelIndex, std::uint64_t>> cells = {};
  std::uint64_t operations = 0;  ///< number of cells visited along all rays
};

/// Second loop of Algorithm 1: adds the utility of each ray to every reachable cell on it, between `min_range_m` and
/// `max_range_m` beyond its frontier cell. A ray ends before the first cell that is neither reachable nor free.
[[nodiscard]] AccumulatedUtility accumulate_utility(const OccupancyMap& map, const ReachableSpace& reachable,
                                                    std::span<const UtilityVector> vectors, double min_range_m,
                                                    double max_range_m);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/utility_vectors.ipp>
#endif
