// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Which cells count as neighbours: those that share a face (6), a face or an edge (18), or also a corner (26).
enum class Connectivity : std::uint8_t { Face6, Edge18, Corner26 };

/// Groups cells into connected clusters. `cells` may have any order; duplicates count once. Cells within a cluster
/// are in raster order, and clusters are ordered by their first cell.
[[nodiscard]] std::vector<std::vector<VoxelIndex>> voxel_clusters(std::vector<VoxelIndex> cells,
                                                                  Connectivity connectivity = Connectivity::Corner26);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/voxel_clusters.ipp>
#endif
