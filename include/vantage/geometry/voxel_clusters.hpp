// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Which cells count as neighbours: those that share a face, those and the ones that share an edge, or all 26.
enum class Connectivity : std::uint8_t { Face6, Edge18, Corner26 };

/// The connected clusters of a list of cells (any order; a cell listed twice counts once). Cells within a cluster are
/// in raster order, and so are the clusters by their first cells.
[[nodiscard]] std::vector<std::vector<VoxelIndex>> voxel_clusters(std::vector<VoxelIndex> cells,
                                                                  Connectivity connectivity = Connectivity::Corner26);

}  // namespace vantage
