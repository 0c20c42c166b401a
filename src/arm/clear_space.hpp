// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_grid.hpp>

namespace vantage::detail {

// The cells that the body may touch, and how far each is from the next that it may not: most of an arm is far from
// everything, and is found clear in few steps.
class ClearSpace {
 public:
  // Of a grid that holds not 0 where a cell is clear. Nothing beyond the grid is.
  ClearSpace(const VoxelFrame& frame, VoxelGrid<std::uint8_t> clear);

  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  [[nodiscard]] const VoxelGrid<std::uint8_t>& rings() const { return rings_; }
  [[nodiscard]] bool is_clear(const VoxelIndex& cell) const { return rings_.value_or(cell, 0) != 0; }
  // A cell that is not clear and that a sphere touches while its centre goes from `from` to `to`; none if there is
  // none. With the same cells it is always the same.
  [[nodiscard]] std::optional<VoxelIndex> obstacle(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                   double radius_m) const;

 private:
  // What a walk along the middle tells.
  struct Walk {
    std::optional<VoxelIndex> obstacle;
    bool far_from_any = true;  // so far all along that nothing can be touched
  };
  [[nodiscard]] Walk walk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double touching_m) const;

  VoxelFrame frame_;
  VoxelGrid<std::uint8_t> rings_;  // of cells about each that are all clear, itself the first; no more than a few
};

}  // namespace vantage::detail
