// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vantage/geometry/voxel.hpp>

namespace vantage {

/// The cells that a segment passes, in order, from the cell of `from` to the cell of `to`, both included: the exact
/// traversal of Amanatides & Woo 1987, in double precision.
///
///     for (const VoxelIndex& cell : VoxelRay(frame, from, to)) { ... }
///
/// Each step crosses one face; the walk takes exactly as many steps as the two end cells differ, so rounding can never
/// make it miss its end. Where the segment passes exactly through an edge or a corner, the lower axis steps first.
class VoxelRay {
 public:
  /// Both points must be addressable in `frame`.
  VoxelRay(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const VoxelIndex first = frame.cell_of(from);
    const VoxelIndex last = frame.cell_of(to);
    cell_ = {first.x, first.y, first.z};
    const std::array<std::int32_t, 3> end{last.x, last.y, last.z};
    const Eigen::Vector3d step_m = to - from;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      remaining_[axis] = std::abs(end[axis] - cell_[axis]);
      steps_ += remaining_[axis];
      sign_[axis] = end[axis] >= cell_[axis] ? 1 : -1;
      const double face_m = (cell_[axis] + (sign_[axis] > 0 ? 1 : 0)) * frame.size_m;
      next_[axis] = remaining_[axis] > 0 ? (face_m - from[i]) / step_m[i] : kNever;
      delta_[axis] = remaining_[axis] > 0 ? frame.size_m / std::abs(step_m[i]) : kNever;
    }
  }

  class iterator;

  /// At the first cell.
  [[nodiscard]] iterator begin() const;
  /// Past the last cell.
  [[nodiscard]] static std::default_sentinel_t end() { return {}; }
  /// Number of cells on the walk.
  [[nodiscard]] std::int64_t size() const { return steps_ + 1; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  void advance() {
    --steps_;
    if (steps_ < 0) {
      return;
    }
    std::size_t axis = 0;
    if (next_[1] < next_[axis]) {
      axis = 1;
    }
    if (next_[2] < next_[axis]) {
      axis = 2;
    }
    cell_[axis] += sign_[axis];
    next_[axis] = --remaining_[axis] > 0 ? next_[axis] + delta_[axis] : kNever;
  }

  std::array<std::int32_t, 3> cell_{};
  std::array<std::int32_t, 3> sign_{};
  std::array<std::int32_t, 3> remaining_{};
  std::array<double, 3> next_{};
  std::array<double, 3> delta_{};
  std::int64_t steps_ = 0;
};

/// Walks from cell to cell; a single pass.
class VoxelRay::iterator {
 public:
  using iterator_category = std::input_iterator_tag;  ///< as std::iterator_traits asks
  using value_type = VoxelIndex;  ///< as std::iterator_traits asks
  using difference_type = std::ptrdiff_t;  ///< as std::iterator_traits asks
  using pointer = const VoxelIndex*;  ///< as std::iterator_traits asks
  using reference = VoxelIndex;  ///< as std::iterator_traits asks

  /// The cell reached.
  VoxelIndex operator*() const { return {ray_.cell_[0], ray_.cell_[1], ray_.cell_[2]}; }
  /// On to the next cell.
  iterator& operator++() {
    ray_.advance();
    return *this;
  }
  /// Whether the last cell is behind.
  bool operator==(std::default_sentinel_t) const { return ray_.steps_ < 0; }

 private:
  friend class VoxelRay;
  explicit iterator(const VoxelRay& ray) : ray_(ray) {}
  VoxelRay ray_;
};

inline VoxelRay::iterator VoxelRay::begin() const { return iterator(*this); }

}  // namespace vantage
