// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/sim/triangle_mesh.hpp>
#include <vantage/sim/truth.hpp>

namespace vantage {

/// Marks every cell of the grid that a triangle passes. A triangle that passes only within `grazed_share` of the
/// cell's edge from its faces marks the cell as grazed.
void rasterise(const TriangleMesh& mesh, const VoxelFrame& frame, double grazed_share, VoxelGrid<CellTruth>& cells);

}  // namespace vantage
