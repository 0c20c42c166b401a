// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// A cell as an integer point, in cells. Hulls of integer points are exact.
inline Eigen::Vector3d lattice_point(const VoxelIndex& cell) { return Eigen::Vector3d(cell.x, cell.y, cell.z); }

}  // namespace vantage::detail
