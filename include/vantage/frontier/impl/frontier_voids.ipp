// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vantage/frontier/frontier_voids.hpp>

namespace vantage {
namespace detail {

// The voids adjacent to a cell, each once.
inline std::vector<std::uint32_t> voids_beside(const VoidClusters& voids, const VoxelIndex& cell) {
  std::vector<std::uint32_t> beside;
  for (const VoxelIndex& step : kFaceNeighbours) {
    const std::uint32_t number = voids.number_at(cell + step);
    if (number != VoidClusters::kNone && std::find(beside.begin(), beside.end(), number) == beside.end()) {
      beside.push_back(number);
    }
  }
  return beside;
}

}  // namespace detail

VANTAGE_INLINE std::vector<FrontierVoid> combine_frontier_voids(
    const VoidClusters& voids, std::span<const std::vector<VoxelIndex>> frontier_clusters, FrontierShare share) {
  std::vector<FrontierVoid> all(voids.clusters().size());
  for (std::uint32_t number = 0; number < frontier_clusters.size(); ++number) {
    const std::vector<VoxelIndex>& cells = frontier_clusters[number];
    for (const VoxelIndex& cell : cells) {
      for (const std::uint32_t beside : detail::voids_beside(voids, cell)) {
        FrontierVoid& here = all[beside];
        const bool first = here.frontier_clusters.empty() || here.frontier_clusters.back() != number;
        if (first) {
          here.frontier_clusters.push_back(number);
        }
        if (share == FrontierShare::TouchingCells) {
          here.frontier.push_back(cell);
        } else if (first) {
          here.frontier.insert(here.frontier.end(), cells.begin(), cells.end());
        }
      }
    }
  }
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    all[i].cluster = i;
    all[i].utility = voids.clusters()[i].size;
  }
  std::erase_if(all, [](const FrontierVoid& one) { return one.frontier_clusters.empty(); });
  return all;
}

}  // namespace vantage
