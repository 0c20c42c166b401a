// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// The intersection of two boxes; may be empty.
[[nodiscard]] inline VoxelBox box_overlap(const VoxelBox& a, const VoxelBox& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

}  // namespace vantage::detail
