// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/frontier/void_clusters.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Which cells of the adjacent frontier clusters are used to look into a void.
enum class FrontierShare : std::uint8_t {
  TouchingCells,  ///< only cells that share a face with a cell of the void
  WholeClusters,  ///< all cells, as in the paper; the frontier around a whole room may be a single cluster
};

/// A void with the frontier through which it can be seen, and its utility: `fv = (v, F, u)` of Dornhege & Kleiner
/// 2011, IV-B.
struct FrontierVoid {
  std::uint32_t cluster = 0;                     ///< the void `v`, as an index into VoidClusters::clusters()
  std::vector<std::uint32_t> frontier_clusters;  ///< `F`: the adjacent frontier clusters, ascending
  std::vector<VoxelIndex> frontier;              ///< their cells, selected by FrontierShare, cluster by cluster
  std::size_t utility = 0;  ///< `u`: the number of void cells that may be seen, which is the size of the void
};

/// Combines voids with the frontier clusters adjacent to them. They are adjacent if a cell of one shares a face with
/// a cell of the other. The result follows the order of the void clusters. A void without an adjacent frontier is
/// left out, because no view can look into it. Frontier clusters are numbered by their position in
/// `frontier_clusters`.
[[nodiscard]] std::vector<FrontierVoid> combine_frontier_voids(
    const VoidClusters& voids, std::span<const std::vector<VoxelIndex>> frontier_clusters,
    FrontierShare share = FrontierShare::TouchingCells);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/frontier_voids.ipp>
#endif
