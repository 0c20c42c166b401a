// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <vantage/geometry/disjoint_sets.hpp>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/geometry/voxel_clusters.hpp>

namespace vantage {
namespace detail {

inline bool connects(const VoxelIndex& step, Connectivity connectivity) {
  const int axes = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
  return axes <= (connectivity == Connectivity::Face6 ? 1 : connectivity == Connectivity::Edge18 ? 2 : 3);
}

// Merges the sets of all pairs of cells that differ by `step`. The pairs are found by merging the list with the
// shifted list; both are in raster order.
inline void merge_neighbours(const std::vector<VoxelIndex>& cells, const VoxelIndex& step, DisjointSets& sets) {
  constexpr RasterOrder kBefore;
  std::size_t neighbour = 0;
  for (std::size_t i = 0; i < cells.size() && neighbour < cells.size(); ++i) {
    const VoxelIndex wanted = cells[i] + step;
    while (neighbour < cells.size() && kBefore(cells[neighbour], wanted)) {
      ++neighbour;
    }
    if (neighbour < cells.size() && cells[neighbour] == wanted) {
      sets.merge(i, neighbour);
    }
  }
}

}  // namespace detail

VANTAGE_INLINE std::vector<std::vector<VoxelIndex>> voxel_clusters(std::vector<VoxelIndex> cells,
                                                                   Connectivity connectivity) {
  sort_unique(cells);
  DisjointSets sets(cells.size());
  for (const VoxelIndex& step : kAllNeighbours) {
    const bool later = RasterOrder{}(VoxelIndex{}, step);  // the opposite steps would find the same pairs
    if (later && detail::connects(step, connectivity)) {
      detail::merge_neighbours(cells, step, sets);
    }
  }
  std::vector<std::vector<VoxelIndex>> clusters(sets.count());
  const std::vector<std::size_t> labels = sets.labels();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    clusters[labels[i]].push_back(cells[i]);
  }
  return clusters;
}

}  // namespace vantage
