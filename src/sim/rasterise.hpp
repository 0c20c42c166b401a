// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/sim/triangle_mesh.hpp>
#include <vantage/sim/true_cells.hpp>

namespace vantage {

/// Marks every cell that a triangle passes. A triangle that passes only within `grazed_share` of the
/// cell's edge from its faces marks the cell as grazed.
void rasterise(const TriangleMesh& mesh, const VoxelFrame& frame, double grazed_share, TrueCells& cells);

}  // namespace vantage
