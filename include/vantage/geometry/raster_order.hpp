// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Raster order of cells: by z, then y, then x, the order in which `for_each_cell` visits a box.
struct RasterOrder {
  /// Whether `a` comes before `b`.
  constexpr bool operator()(const VoxelIndex& a, const VoxelIndex& b) const {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  }
};

/// Sorts cells in raster order and removes duplicates.
inline void sort_unique(std::vector<VoxelIndex>& cells) {
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace vantage
