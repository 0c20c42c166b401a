// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vantage/geometry/impl/face_crossings.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>

namespace vantage::detail {

/// Walks a single ray: cell by cell where a cell may stop it, and in leaps through free space. Exact, as VoxelRay.
class SingleWalk {
 public:
  /// The ray goes from `from`, which lies in cell `first`, to `to`, which lies in cell `last`.
  SingleWalk(const VoxelFrame& frame, const Eigen::Vector3d& from, const VoxelIndex& first, const Eigen::Vector3d& to,
             const VoxelIndex& last);
  /// Walks on to the first cell that stops the ray. Returns false if there is none; the walk is then at the last
  /// cell.
  bool advance(const BlockingGrid& grid);
  /// The current cell.
  [[nodiscard]] VoxelIndex cell() const { return {cell_[0], cell_[1], cell_[2]}; }

 private:
  bool leave(const VoxelIndex& lo, const VoxelIndex& last);

  std::array<std::int32_t, 3> cell_;
  std::array<std::int32_t, 3> sign_{};
  std::array<FaceCrossings, 3> faces_;
};

inline SingleWalk::SingleWalk(const VoxelFrame& frame, const Eigen::Vector3d& from, const VoxelIndex& first,
                              const Eigen::Vector3d& to, const VoxelIndex& last)
    : cell_{first.x, first.y, first.z} {
  const std::array<std::int32_t, 3> end{last.x, last.y, last.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    sign_[axis] = end[axis] >= cell_[axis] ? 1 : -1;
    faces_[axis] = crossings_between(from[i], to[i], cell_[axis], end[axis], frame.size_m);
  }
}

inline bool SingleWalk::advance(const BlockingGrid& grid) {
  while (true) {
    const VoxelIndex word = CellSet::word_of(cell());
    const std::int32_t free = grid.distance(word) - 1;
    // The word is the middle of a cube of free words, which the ray leaves in one leap.
    if (free >= 0) {
      const VoxelBox cube = VoxelBox{word, word + VoxelIndex{1, 1, 1}}.grown(free);
      if (!leave({cube.lo.x * 4, cube.lo.y * 4, cube.lo.z * 4},
                 {cube.hi.x * 4 - 1, cube.hi.y * 4 - 1, cube.hi.z * 4 - 1})) {
        return false;
      }
      continue;
    }
    const std::uint64_t blocking = grid.blocking(word);
    do {
      if ((blocking & CellSet::bit_of(cell())) != 0) {
        return true;
      }
      if (!leave(cell(), cell())) {
        return false;
      }
    } while (CellSet::word_of(cell()) == word);
  }
}

// Leaves a box of cells through the face that is crossed first. Returns false if the ray ends before.
inline bool SingleWalk::leave(const VoxelIndex& lo, const VoxelIndex& last) {
  const std::array<std::int32_t, 3> least{lo.x, lo.y, lo.z};
  const std::array<std::int32_t, 3> most{last.x, last.y, last.z};
  std::size_t by = 0;
  std::int64_t leaves = FaceCrossings::kEnd + 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t faces = sign_[axis] > 0 ? most[axis] - cell_[axis] : cell_[axis] - least[axis];
    const FaceCrossings& crossings = faces_[axis];
    if (static_cast<double>(faces) * static_cast<double>(crossings.delta) >
        static_cast<double>(FaceCrossings::kEnd)) {
      continue;  // beyond the end of the ray; the product might also overflow
    }
    const std::int64_t crosses = crossings.next + faces * crossings.delta;
    if (crosses < leaves) {
      leaves = crosses;
      by = axis;
    }
  }
  const bool ends = leaves > FaceCrossings::kEnd;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    FaceCrossings& faces = faces_[axis];
    // If faces are crossed at the same time, the lower axis comes first.
    const std::int64_t until = ends ? FaceCrossings::kEnd : leaves - (axis > by ? 1 : 0);
    if (faces.next <= until) {
      const std::int64_t crossed = faces.crossed_by(until);
      cell_[axis] += sign_[axis] * static_cast<std::int32_t>(crossed);
      faces.next += crossed * faces.delta;
    }
  }
  return !ends;
}

}  // namespace vantage::detail
