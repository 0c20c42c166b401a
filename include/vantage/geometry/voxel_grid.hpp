// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A dense array over a box of cells, x fastest, then y, then z. For small domains, and as the reference for sparse
/// structures in tests.
template <class T>
class VoxelGrid {
 public:
  VoxelGrid() = default;
  /// Creates a grid over the cells of `box`, filled with `value`.
  explicit VoxelGrid(const VoxelBox& box, const T& value = T{})
      : box_(box), extent_(box.extent()), values_(box.size(), value) {}

  /// The cells of the grid.
  [[nodiscard]] const VoxelBox& box() const { return box_; }
  /// The number of cells.
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  /// Whether the grid has a cell.
  [[nodiscard]] bool contains(const VoxelIndex& cell) const { return box_.contains(cell); }

  /// Index of a cell in `values()`. The cell must be in the box.
  [[nodiscard]] std::size_t offset_of(const VoxelIndex& cell) const {
    const VoxelIndex from_lo = cell - box_.lo;
    return (static_cast<std::size_t>(from_lo.z) * static_cast<std::size_t>(extent_.y) +
            static_cast<std::size_t>(from_lo.y)) *
               static_cast<std::size_t>(extent_.x) +
           static_cast<std::size_t>(from_lo.x);
  }
  /// The cell at an index of `values()`.
  [[nodiscard]] VoxelIndex cell_at(std::size_t offset) const {
    const auto row = static_cast<std::size_t>(extent_.x);
    const auto plane = row * static_cast<std::size_t>(extent_.y);
    return box_.lo + VoxelIndex{static_cast<std::int32_t>(offset % row),
                                static_cast<std::int32_t>(offset % plane / row),
                                static_cast<std::int32_t>(offset / plane)};
  }

  /// The value of a cell, which must be in the box.
  [[nodiscard]] decltype(auto) operator[](const VoxelIndex& cell) { return values_[offset_of(cell)]; }
  /// The value of a cell, which must be in the box.
  [[nodiscard]] decltype(auto) operator[](const VoxelIndex& cell) const { return values_[offset_of(cell)]; }
  /// The value of a cell, or `outside` if the cell is not in the box.
  [[nodiscard]] T value_or(const VoxelIndex& cell, const T& outside) const {
    return contains(cell) ? static_cast<T>(values_[offset_of(cell)]) : outside;
  }

  /// All values, x running fastest, then y, then z.
  [[nodiscard]] std::vector<T>& values() { return values_; }
  /// All values, x running fastest, then y, then z.
  [[nodiscard]] const std::vector<T>& values() const { return values_; }

 private:
  VoxelBox box_;
  VoxelIndex extent_;  // of the box
  std::vector<T> values_;
};

}  // namespace vantage
