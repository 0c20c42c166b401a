// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage::detail {

// The cells that the body may touch, and for each a lower bound on the distance to other cells. Most of an arm is far
// from obstacles, and a few steps show that it is free.
class ClearSpace {
 public:
  // `clear` is non-zero for clear cells. Cells outside the grid are not clear.
  ClearSpace(const VoxelFrame& frame, VoxelGrid<std::uint8_t> clear);

  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  [[nodiscard]] const VoxelGrid<std::uint8_t>& rings() const { return rings_; }
  [[nodiscard]] bool is_clear(const VoxelIndex& cell) const { return rings_.value_or(cell, 0) != 0; }
  // A cell that is not clear and is touched by a sphere whose centre moves from `from` to `to` (world frame, metres);
  // nullopt if there is none. Deterministic for equal inputs.
  [[nodiscard]] std::optional<VoxelIndex> obstacle(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                   double radius_m) const;

 private:
  // Result of a walk along the segment.
  struct Walk {
    std::optional<VoxelIndex> obstacle;
    bool far_from_any = true;  // the whole segment is so far from obstacles that the sphere touches none
  };
  [[nodiscard]] Walk walk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double touching_m) const;

  VoxelFrame frame_;
  // per cell: number of surrounding rings of cells that are all clear, the cell itself included; at most 6
  VoxelGrid<std::uint8_t> rings_;
};

}  // namespace vantage::detail
