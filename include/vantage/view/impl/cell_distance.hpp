// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// In cells.
inline double squared_distance(const VoxelIndex& a, const VoxelIndex& b) {
  const VoxelIndex d = a - b;
  return static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y + static_cast<double>(d.z) * d.z;
}

}  // namespace vantage::detail
