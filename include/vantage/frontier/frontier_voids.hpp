// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/frontier/void_clusters.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Which cells of the frontier clusters that neighbour a void are looked through into it.
enum class FrontierShare : std::uint8_t {
  TouchingCells,  ///< those that share a face with a cell of the void
  WholeClusters,  ///< all of them, as the paper has it: a frontier around a whole room is one cluster
};

/// A void, the frontier through which it can be seen, and what that is worth: `fv = (v, F, u)` of Dornhege & Kleiner
/// 2011, IV-B.
struct FrontierVoid {
  std::uint32_t cluster = 0;                     ///< the void `v`, as a position in VoidClusters::clusters()
  std::vector<std::uint32_t> frontier_clusters;  ///< `F`: those that neighbour the void, ascending
  std::vector<VoxelIndex> frontier;              ///< their cells by FrontierShare, cluster by cluster
  std::size_t utility = 0;                       ///< `u`: the volume that may be seen, in cells: the size of the void
};

/// The voids that some frontier cluster neighbours (a cell of one shares a face with a cell of the other), in the
/// order of the void clusters. A void without frontier cannot be seen into, and is none of them. Frontier clusters
/// are numbered as given.
[[nodiscard]] std::vector<FrontierVoid> combine_frontier_voids(
    const VoidClusters& voids, std::span<const std::vector<VoxelIndex>> frontier_clusters,
    FrontierShare share = FrontierShare::TouchingCells);

}  // namespace vantage
