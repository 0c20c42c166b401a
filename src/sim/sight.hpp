// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/sim/truth.hpp>
#include <vector>

namespace vantage {

/// Tells whether a sensor at the centre of one cell of the true world sees another cell; rules as
/// Truth::observable.
class Sight {
 public:
  Sight(const TrueCells& cells, const VoxelFrame& frame, const RangeSensor& sensor, bool can_tilt)
      : cells_(cells), frame_(frame), sensor_(sensor), can_tilt_(can_tilt) {}

  /// Whether it sees the centre of the cell.
  [[nodiscard]] bool sees(const VoxelIndex& pose, const VoxelIndex& cell) const;
  /// Whether it sees the centre of the cell, or a point just inside one of its faces, edges or corners.
  [[nodiscard]] bool sees_part(const VoxelIndex& pose, const VoxelIndex& cell) const;
  [[nodiscard]] bool is_free(const VoxelIndex& cell) const { return cells_[cell] == CellTruth::Free; }
  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  [[nodiscard]] const RangeSensor& sensor() const { return sensor_; }

 private:
  [[nodiscard]] bool sees_point(const VoxelIndex& pose, const VoxelIndex& cell, const Eigen::Vector3d& to) const;
  [[nodiscard]] bool ends_on_a_surface(const Eigen::Vector3d& pose_m, const Eigen::Vector3d& cell_m) const;

  const TrueCells& cells_;
  VoxelFrame frame_;
  RangeSensor sensor_;
  bool can_tilt_;
};

/// Cells of the region that at least one pose sees, in raster order; `on_share` as in Truth::observable.
[[nodiscard]] std::vector<VoxelIndex> seen_cells(const Sight& sight, const VoxelBox& region,
                                                 const std::vector<VoxelIndex>& poses, int threads,
                                                 const std::function<void(double)>& on_share = {});

}  // namespace vantage
