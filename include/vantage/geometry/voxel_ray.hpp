// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vantage/compiler.hpp>
#include <vantage/geometry/voxel.hpp>

namespace VANTAGE_EXPORT vantage {

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

  /// These, changed where rounding made it necessary, so that the first `faces` are crossed up to kEnd and no more.
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
/// first. The times are computed in the library, so the cells do not depend on the instructions that a host is built
/// for.
class VoxelRay {
 public:
  /// Both points must be addressable in `frame`.
  VoxelRay(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

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
