// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>

namespace vantage {

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

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/single_walk.ipp>
#endif
