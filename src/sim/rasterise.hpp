// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/sim/triangle_mesh.hpp>
#include <vantage/sim/truth.hpp>

namespace vantage {

/// Marks every cell of the grid that a triangle passes. `grazed_share` of a cell's edge, from each face inwards,
/// counts as grazed only.
void rasterise(const TriangleMesh& mesh, const VoxelFrame& frame, double grazed_share, VoxelGrid<CellTruth>& cells);

}  // namespace vantage
