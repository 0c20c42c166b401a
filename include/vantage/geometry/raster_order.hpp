// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

/// Raster order of cells: by z, then y, then x, the order in which `for_each_cell` visits a box.
struct RasterOrder {
  /// Whether `a` comes before `b`.
  constexpr bool operator()(const VoxelIndex& a, const VoxelIndex& b) const {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  }
};

}  // namespace vantage
