// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The body that carries the sensor: which poses and motions the current map admits, and paths between them. All
/// poses are those of the sensor, world_from_sensor. Unknown space is never admitted.
class Platform {
 public:
  virtual ~Platform() = default;

  /// Whether the sensor may be at this pose: the body touches clear cells only.
  [[nodiscard]] virtual bool admits(const OccupancyMap& map, const Pose& pose) const = 0;
  /// Whether the sensor may be at the centre of this cell, in at least one orientation.
  [[nodiscard]] virtual bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const = 0;
  /// The cells of `box` that the platform admits, as 1. Must equal `admits_cell` for each cell; a platform may
  /// compute all of them faster together. Allocates memory for the whole box.
  [[nodiscard]] virtual VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const;
  /// Distance from the sensor to the end of the body, metres: cells further away, and more than a cell away, must not
  /// affect whether a cell is admitted. Infinite if unknown.
  [[nodiscard]] virtual double reach_m() const { return std::numeric_limits<double>::infinity(); }
  /// Whether the body may move the sensor straight from one pose to the other: all cells that it touches in between
  /// are clear, or are already touched at `from`. So a body can leave a place that is found too narrow.
  [[nodiscard]] virtual bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const = 0;
  /// The pose at `position_m` (metres, world) whose optical axis is as close to `direction` (world) as the platform
  /// allows; a yaw-only platform stays horizontal. If it cannot tilt, the orientation must depend on `direction`
  /// alone.
  [[nodiscard]] virtual Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const = 0;
  /// Length of the path between two poses in free space, metres.
  [[nodiscard]] virtual double distance_m(const Pose& from, const Pose& to) const = 0;
  /// A path through admitted poses, both ends included; consecutive poses are joined by admitted motions. None if
  /// there is none.
  [[nodiscard]] virtual std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                              const Pose& to) const = 0;
  /// Axis-aligned box around the body at `pose`, metres, world.
  [[nodiscard]] virtual Box body_box(const Pose& pose) const = 0;
  /// Whether the sensor can be pitched, so that `facing` reaches every direction.
  [[nodiscard]] virtual bool can_tilt() const = 0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/platform.ipp>
#endif
