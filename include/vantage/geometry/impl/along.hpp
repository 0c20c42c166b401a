// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>

namespace vantage::detail {

/// The coordinate of a cell along axis 0 (x), 1 (y) or 2 (z).
[[nodiscard]] constexpr std::int32_t along(const VoxelIndex& cell, std::size_t axis) {
  return axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z;
}
/// The coordinate of a cell along an axis, to write to.
[[nodiscard]] constexpr std::int32_t& along(VoxelIndex& cell, std::size_t axis) {
  return axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z;
}

}  // namespace vantage::detail
