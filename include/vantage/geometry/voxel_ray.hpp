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

/// The times at which a segment crosses the cell faces across one axis: first at `next`, then every `delta`. Time
/// runs from 0 at the start of the segment to kEnd at its end. Faces before the end cell are crossed at or before
/// kEnd; all further ones after it.
///
/// Time is an integer, so the state after n steps is an exact product and not a rounded sum. All walks that compare
/// times, in any order and with any instruction set, therefore visit the same cells.
struct FaceCrossings {
  std::int64_t next = 0;   ///< time of the next face
  std::int64_t delta = 0;  ///< time between faces

  /// Time at the end of the segment. Leaves room for a step beyond it.
  static constexpr std::int64_t kEnd = std::int64_t{1} << 60U;
  /// A time after all crossings.
  static constexpr std::int64_t kNever = std::int64_t{1} << 62U;

  /// Corrects rounding so that exactly `faces` faces are crossed up to kEnd.
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
  /// The number of faces crossed up to and including `time`.
  [[nodiscard]] std::int64_t crossed_by(std::int64_t time) const {
    return time < next ? 0 : (time - next) / delta + 1;
  }
};

/// The cells on a segment from `from` to `to` (world frame, metres), in order, both end cells included.
///
///     for (const VoxelIndex& cell : VoxelRay(frame, from, to)) { ... }
///
/// Each step crosses one face. The number of steps is the difference of the end cells, so rounding cannot make the
/// walk miss the end cell. If the segment passes exactly through an edge or a corner, the lower axis steps first.
/// Times are computed in the library, so the cells do not depend on the compiler flags of the host. (Amanatides & Woo
/// 1987; time in units of 2^-60 of the segment.)
class VoxelRay {
 public:
  /// Both points must be addressable in `frame`.
  VoxelRay(const VoxelFrame& frame, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  class iterator;

  /// Iterator at the first cell.
  [[nodiscard]] iterator begin() const;
  /// Sentinel after the last cell.
  [[nodiscard]] static std::default_sentinel_t end() { return {}; }
  /// The number of cells.
  [[nodiscard]] std::int64_t size() const { return steps_ + 1; }
  /// Calls `holds(cell)` for the cells in reverse order until a call returns false. Returns whether all calls
  /// returned true. The cells are those of the forward walk; a walk from `to` to `from` may visit others.
  template <class Holds>
  [[nodiscard]] bool all_from_the_end(Holds&& holds) const;
  /// Calls `holds(cell)` for the cells in the order of the walk until a call returns false. Where the segment passes
  /// through an edge or a corner (within 1e-9 of its length), it calls it for all cells around that point. Returns
  /// whether all calls returned true.
  template <class Holds>
  [[nodiscard]] bool all_touched(Holds&& holds) const;

 private:
  void advance() {
    --steps_;
    if (steps_ < 0) {
      return;
    }
    // No computed indices, so that a loop keeps its state in registers.
    const bool y_before_x = faces_[1].next < faces_[0].next;
    const bool is_z = faces_[2].next < (y_before_x ? faces_[1].next : faces_[0].next);
    cross(0, !is_z && !y_before_x);
    cross(1, !is_z && y_before_x);
    cross(2, is_z);
  }
  void cross(std::size_t axis, bool is_next) {
    cell_[axis] += is_next ? sign_[axis] : 0;
    faces_[axis].next += is_next ? faces_[axis].delta : 0;
  }

  std::array<std::int32_t, 3> cell_{};
  std::array<std::int32_t, 3> sign_{};
  std::array<FaceCrossings, 3> faces_{};
  std::int64_t steps_ = 0;
};

// The forward walk steps in the order of the times, the lower axis first among equal times. So the reverse walk
// undoes the latest step first, the higher axis first.
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
    const bool y_after_z = latest[1] > latest[2];
    const bool is_x = latest[0] > (y_after_z ? latest[1] : latest[2]);
    const std::array<bool, 3> is_latest{is_x, !is_x && y_after_z, !is_x && !y_after_z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t before = latest[axis] == faces_[axis].next ? kNone : latest[axis] - faces_[axis].delta;
      cell[axis] -= is_latest[axis] ? sign_[axis] : 0;
      latest[axis] = is_latest[axis] ? before : latest[axis];
    }
  }
}

template <class Holds>
bool VoxelRay::all_touched(Holds&& holds) const {
  constexpr std::int64_t kAtOnce = FaceCrossings::kEnd / 1'000'000'000;
  std::array<std::int32_t, 3> cell = cell_;
  std::array<FaceCrossings, 3> faces = faces_;
  if (!holds(VoxelIndex{cell[0], cell[1], cell[2]})) {
    return false;
  }
  for (std::int64_t left = steps_; left > 0;) {
    const std::int64_t time = std::min({faces[0].next, faces[1].next, faces[2].next});
    std::array<std::int32_t, 3> step{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (faces[axis].next <= FaceCrossings::kEnd && faces[axis].next - time <= kAtOnce) {
        step[axis] = sign_[axis];
        faces[axis].next += faces[axis].delta;
        --left;
      }
    }
    for (unsigned int part = 1; part < 8; ++part) {  // every subset of the faces that are crossed at once
      bool crosses = true;
      std::array<std::int32_t, 3> around = cell;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((part >> axis & 1U) != 0U) {
          crosses = crosses && step[axis] != 0;
          around[axis] += step[axis];
        }
      }
      if (crosses && !holds(VoxelIndex{around[0], around[1], around[2]})) {
        return false;
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell[axis] += step[axis];
    }
  }
  return true;
}

/// A single-pass iterator over the cells.
class VoxelRay::iterator {
 public:
  using iterator_category = std::input_iterator_tag;  ///< required by std::iterator_traits
  using value_type = VoxelIndex;                      ///< required by std::iterator_traits
  using difference_type = std::ptrdiff_t;             ///< required by std::iterator_traits
  using pointer = const VoxelIndex*;                  ///< required by std::iterator_traits
  using reference = VoxelIndex;                       ///< required by std::iterator_traits

  /// The current cell.
  VoxelIndex operator*() const { return {ray_.cell_[0], ray_.cell_[1], ray_.cell_[2]}; }
  /// Moves to the next cell.
  iterator& operator++() {
    ray_.advance();
    return *this;
  }
  /// Whether the iterator is past the last cell.
  bool operator==(std::default_sentinel_t) const { return ray_.steps_ < 0; }

 private:
  friend class VoxelRay;
  explicit iterator(const VoxelRay& ray) : ray_(ray) {}
  VoxelRay ray_;
};

inline VoxelRay::iterator VoxelRay::begin() const { return iterator(*this); }

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/voxel_ray.ipp>
#endif
