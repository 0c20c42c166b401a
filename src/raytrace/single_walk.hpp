// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <raytrace/blocking_grid.hpp>
#include <vantage/geometry/voxel_ray.hpp>

namespace vantage {

/// The walk of one ray, from cell to cell where something may stop it and in leaps where nothing does.
class SingleWalk {
 public:
  /// From `from`, in cell `first`, to `to`, in cell `last`.
  SingleWalk(const VoxelFrame& frame, const Eigen::Vector3d& from, const VoxelIndex& first, const Eigen::Vector3d& to,
             const VoxelIndex& last);
  /// Walks on to the first cell that stops the ray; false: there is none, and it is in the last cell.
  bool advance(const BlockingGrid& grid);
  /// Where it is.
  [[nodiscard]] VoxelIndex cell() const { return {cell_[0], cell_[1], cell_[2]}; }

 private:
  bool leave(const VoxelIndex& lo, const VoxelIndex& last);

  std::array<std::int32_t, 3> cell_;
  std::array<std::int32_t, 3> sign_{};
  std::array<FaceCrossings, 3> faces_;
};

}  // namespace vantage
