// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// A cell as the point of a lattice, in cells: hulls of such points are exact.
inline Eigen::Vector3d lattice_point(const VoxelIndex& cell) { return Eigen::Vector3d(cell.x, cell.y, cell.z); }

}  // namespace vantage::detail
