// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vantage/geometry/voxel.hpp>

namespace vantage {

/// When a segment crosses the faces between cells across one axis: at `next`, and every `delta` from there, where
/// kEnd is the time of its end. Faces up to the cell of its end are crossed up to kEnd, all others after it.
///
/// Time is an integer. So the state of a walk after any number of steps is a product, not a sum that rounds, and
/// every walk that compares times, in whatever order and by whatever instructions, passes the same cells.
struct FaceCrossings {
  std::int64_t next = 0;   ///< time of the next face
  std::int64_t delta = 0;  ///< time from face to face

  /// Time of the end of the segment; leaves room for a step beyond it.
  static constexpr std::int64_t kEnd = std::int64_t{1} << 60U;
  /// Later than any face a walk meets.
  static constexpr std::int64_t kNever = std::int64_t{1} << 62U;

  /// For the coordinates of a segment from `from`, in cell `first`, to `to`, in cell `last`, of cells of `size_m`.
  [[nodiscard]] static FaceCrossings between(double from, double to, std::int32_t first, std::int32_t last,
                                             double size_m) {
    if (first == last) {
      return {kNever, 0};
    }
    constexpr auto kUnit = static_cast<double>(kEnd);
    const double per_metre = std::min(kUnit / std::abs(to - from), 1e200);
    const bool up = last > first;
    const double face_m = (first + (up ? 1 : 0)) * size_m;
    const double next = (up ? face_m - from : from - face_m) * per_metre;
    const FaceCrossings crossings{static_cast<std::int64_t>(std::clamp(next, 0.0, kUnit)),
                                  static_cast<std::int64_t>(std::min(size_m * per_metre, 2.0 * kUnit))};
    return crossings.ending_after(std::abs(last - first));
  }
  /// The same where the first `faces` are crossed up to kEnd, and the next one is not: what rounding may have undone.
  [[nodiscard]] FaceCrossings ending_after(std::int64_t faces) const {
    FaceCrossings crossings = *this;
    if (next + (faces - 1) * delta > kEnd) {
      crossings.delta = std::max<std::int64_t>((kEnd - next) / (faces - 1), 1);
    }
    if (crossings.next + faces * crossings.delta <= kEnd) {
      crossings.next = kEnd + 1 - faces * crossings.delta;
    }
    return crossings;
  }
  /// How many faces are crossed at or before `time`.
  [[nodiscard]] std::int64_t crossed_by(std::int64_t time) const {
    return time < next ? 0 : (time - next) / delta + 1;
  }
};

/// The cells that a segment passes, in order, from the cell of `from` to the cell of `to`, both included: the
/// traversal of Amanatides & Woo 1987, with the time along the segment in units of 2^-60 of it.
///
///     for (const VoxelIndex& cell : VoxelRay(frame, from, to)) { ... }
///
/// Each step crosses one face; the walk takes exactly as many steps as the two end cells differ, so rounding can
/// never make it miss its end. Where the segment passes exactly through an edge or a corner, the lower axis steps
/// first.
class VoxelRay {
 public:
  /// Both points must be addressable in `frame`.
  VoxelRay(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const VoxelIndex first = frame.cell_of(from);
    const VoxelIndex last = frame.cell_of(to);
    cell_ = {first.x, first.y, first.z};
    const std::array<std::int32_t, 3> end{last.x, last.y, last.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      steps_ += std::abs(end[axis] - cell_[axis]);
      sign_[axis] = end[axis] >= cell_[axis] ? 1 : -1;
      faces_[axis] = FaceCrossings::between(from[i], to[i], cell_[axis], end[axis], frame.size_m);
    }
  }

  class iterator;

  /// At the first cell.
  [[nodiscard]] iterator begin() const;
  /// Past the last cell.
  [[nodiscard]] static std::default_sentinel_t end() { return {}; }
  /// Number of cells on the walk.
  [[nodiscard]] std::int64_t size() const { return steps_ + 1; }
  /// Whether `holds(cell)` for every cell of the walk, asked from the last to the first until one refuses: the same
  /// cells as forwards, which a walk between the exchanged ends need not pass.
  template <class Holds>
  [[nodiscard]] bool all_from_the_end(Holds&& holds) const;

 private:
  void advance() {
    --steps_;
    if (steps_ < 0) {
      return;
    }
    std::size_t axis = 0;
    if (faces_[1].next < faces_[axis].next) {
      axis = 1;
    }
    if (faces_[2].next < faces_[axis].next) {
      axis = 2;
    }
    cell_[axis] += sign_[axis];
    faces_[axis].next += faces_[axis].delta;
  }

  std::array<std::int32_t, 3> cell_{};
  std::array<std::int32_t, 3> sign_{};
  std::array<FaceCrossings, 3> faces_{};
  std::int64_t steps_ = 0;
};

// Steps are taken in the order of their times, the lower axis first among equals: undone, the latest comes first.
template <class Holds>
bool VoxelRay::all_from_the_end(Holds&& holds) const {
  constexpr std::int64_t kNone = -1;
  std::array<std::int32_t, 3> cell = cell_;
  std::array<std::int64_t, 3> latest{kNone, kNone, kNone};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (faces_[axis].next <= FaceCrossings::kEnd) {
      const std::int64_t faces = faces_[axis].crossed_by(FaceCrossings::kEnd);
      cell[axis] += sign_[axis] * static_cast<std::int32_t>(faces);
      latest[axis] = faces_[axis].next + (faces - 1) * faces_[axis].delta;
    }
  }
  for (std::int64_t left = steps_;; --left) {
    if (!holds(VoxelIndex{cell[0], cell[1], cell[2]})) {
      return false;
    }
    if (left == 0) {
      return true;
    }
    std::size_t axis = 2;
    if (latest[1] > latest[axis]) {
      axis = 1;
    }
    if (latest[0] > latest[axis]) {
      axis = 0;
    }
    cell[axis] -= sign_[axis];
    latest[axis] = latest[axis] == faces_[axis].next ? kNone : latest[axis] - faces_[axis].delta;
  }
}

/// Walks from cell to cell; a single pass.
class VoxelRay::iterator {
 public:
  using iterator_category = std::input_iterator_tag;  ///< as std::iterator_traits asks
  using value_type = VoxelIndex;                      ///< as std::iterator_traits asks
  using difference_type = std::ptrdiff_t;             ///< as std::iterator_traits asks
  using pointer = const VoxelIndex*;                  ///< as std::iterator_traits asks
  using reference = VoxelIndex;                       ///< as std::iterator_traits asks

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
