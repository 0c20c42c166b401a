// SPDX-License-Identifier: MIT
#pragma once

//
// Dornhege & Kleiner 2011, "A Frontier-Void-Based Approach for Autonomous Exploration in 3D", Algorithm 1.
#include <algorithm>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/brick_grid.hpp>
#include <vantage/view/utility_vectors.hpp>

#include <vantage/map/impl/brick_plane.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kCorners = 7;

// The stride n: only every n-th frontier cell gets rays.
inline std::size_t stride_for(std::span<const FrontierVoid> frontier_voids, std::size_t most) {
  std::size_t lines = 0;
  for (const FrontierVoid& one : frontier_voids) {
    lines += kCorners * one.frontier.size();
  }
  return (lines + most - 1) / most;
}

}  // namespace detail

VANTAGE_INLINE std::vector<UtilityVector> utility_vectors(const VoidClusters& voids,
                                                          std::span<const FrontierVoid> frontier_voids,
                                                          const VoxelFrame& frame, std::size_t most) {
  detail::require_option(most > 0, "utility_vectors: most", most, "> 0");
  const std::size_t stride = detail::stride_for(frontier_voids, most);
  std::vector<UtilityVector> vectors;
  for (const FrontierVoid& one : frontier_voids) {
    const auto corners = voids.clusters()[one.cluster].ellipsoid.corners();
    for (std::size_t i = 0; i < one.frontier.size(); i += stride) {
      const Eigen::Vector3d position = frame.centre_of(one.frontier[i]);
      for (const Eigen::Vector3d& corner : corners) {
        const Eigen::Vector3d line = position - corner;
        if (const double length = line.norm(); length > 0.0) {
          vectors.push_back({one.frontier[i], line / length, one.utility * stride});
        }
      }
    }
  }
  return vectors;
}

VANTAGE_INLINE AccumulatedUtility accumulate_utility(const OccupancyMap& map, const ReachableSpace& reachable,
                                                     std::span<const UtilityVector> vectors, double min_range_m,
                                                     double max_range_m) {
  const VoxelFrame& frame = map.frame();
  // Rays need not go beyond the known part of the map. The range of a sensor may be infinite.
  const double furthest_m = std::min(max_range_m, frame.box_of(map.bounds()).extent().norm() + frame.size_m);
  AccumulatedUtility utility;
  BrickGrid<std::uint64_t> sums(0);
  BrickGrid<std::uint64_t>::Writer sum_of(sums);
  VoxelIndex brick;  // that a ray is in, and its reachable cells; null if it has none
  const BrickPlane* places = nullptr;
  for (const UtilityVector& vector : vectors) {
    const Eigen::Vector3d from = frame.centre_of(vector.frontier);
    for (const VoxelIndex& cell : VoxelRay(frame, from, from + furthest_m * vector.direction)) {
      ++utility.operations;
      if (const VoxelIndex in = Brick::of_cell(cell); in != brick || places == nullptr) {
        brick = in;
        places = reachable.find(brick);
      }
      if (places == nullptr || !detail::has(*places, Brick::offset_of(cell))) {
        if (map.at(cell) != Occupancy::Free) {
          break;
        }
      } else if ((frame.centre_of(cell) - from).squaredNorm() >= min_range_m * min_range_m) {
        sum_of(cell) += vector.utility;
      }
    }
  }
  for (std::size_t number = 0; number < sums.bricks(); ++number) {
    for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
      if (const std::uint64_t sum = sums.values(number)[offset]; sum > 0) {
        utility.cells.emplace_back(Brick::cell_at(sums.address(number), offset), sum);
      }
    }
  }
  std::sort(utility.cells.begin(), utility.cells.end(),
            [](const auto& a, const auto& b) { return RasterOrder{}(a.first, b.first); });
  return utility;
}

}  // namespace vantage
