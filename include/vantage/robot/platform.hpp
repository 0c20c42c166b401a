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

/// What carries the sensor: which poses it admits in the map as known now, how far apart two are, and how it gets
/// from one to the other. All poses are of the sensor, `world_from_sensor`. Unknown space is never admitted.
class Platform {
 public:
  virtual ~Platform() = default;

  /// Whether the sensor may be at this pose: the platform's body touches known-free cells only.
  [[nodiscard]] virtual bool admits(const OccupancyMap& map, const Pose& pose) const = 0;
  /// Whether the sensor may be at the centre of this cell, in at least one orientation.
  [[nodiscard]] virtual bool admits_cell(const OccupancyMap& map, const VoxelIndex& cell) const = 0;
  /// Every cell of `box` that the platform admits, as 1: the same answer as `admits_cell` cell by cell, which a
  /// platform may know how to give faster for all of them at once. Memory follows the box (AdmittedCells asks for no
  /// box that is much larger than what is known in it).
  [[nodiscard]] virtual VoxelGrid<std::uint8_t> admitted_cells(const OccupancyMap& map, const VoxelBox& box) const;
  /// How far from the sensor the body ends, metres: whether a cell is admitted never depends on cells that lie
  /// further off. Infinite where that is not known.
  [[nodiscard]] virtual double reach_m() const { return std::numeric_limits<double>::infinity(); }
  /// Whether the platform may move the sensor straight from one pose to the other: every cell that the body touches
  /// on the way is known free, or touched already at `from` (so that a platform may leave a place found too tight).
  [[nodiscard]] virtual bool admits_motion(const OccupancyMap& map, const Pose& from, const Pose& to) const = 0;
  /// The pose at `position_m` whose optical axis comes nearest to `direction` among the orientations the platform can
  /// take (a yaw-only platform keeps level).
  [[nodiscard]] virtual Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const = 0;
  /// Length of the way between two poses in free space, metres.
  [[nodiscard]] virtual double distance_m(const Pose& from, const Pose& to) const = 0;
  /// A way through poses the platform admits, both ends included, consecutive ones joined by an admitted motion; none
  /// if there is none.
  [[nodiscard]] virtual std::optional<std::vector<Pose>> path(const OccupancyMap& map, const Pose& from,
                                                              const Pose& to) const = 0;
  /// The space the body takes at `pose`, as a box: what a host may declare free before the first scan.
  [[nodiscard]] virtual Box body_box(const Pose& pose) const = 0;
  /// Whether the sensor can be turned to look along `direction` (a yaw-only platform cannot pitch).
  [[nodiscard]] virtual bool can_tilt() const = 0;
};

}  // namespace vantage
