// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/picture.hpp>

namespace VANTAGE_EXPORT vantage {

/// A potential over cells and what belongs to it. Spans must outlive the call only.
struct FieldContent {
  std::string title = {};                     ///< above the picture
  std::span<const VoxelIndex> cells = {};     ///< where the field is known, in any order
  std::span<const double> phi = {};           ///< its value at each of `cells`: 1 at the sensor, 0 at the frontier
  std::span<const VoxelIndex> frontier = {};  ///< cells held at 0
  std::span<const Eigen::Vector3d> streamline = {};    ///< the way of steepest descent from the sensor, may be empty
  Eigen::Vector3d sensor_m = Eigen::Vector3d::Zero();  ///< position of the sensor
  std::optional<Box> extent = std::nullopt;            ///< the part of the world to show; none: all that is known
  /// Height of the slice, metres; none: the sensor's height.
  std::optional<double> slice_z_m = std::nullopt;
};

/// A horizontal slice through the field: its value as colour, arrows down its gradient, the frontier cells of the
/// slice in red, the streamline (all heights) in white, walls black. The colours follow the *rank* of phi over the
/// slice, not phi itself: a potential falls steeply about the sensor and is nearly level elsewhere, where a colour
/// for equal steps of phi would show nothing; the colour bar carries the values. Throws std::invalid_argument if
/// `cells` and `phi` differ in length or the extent is empty.
[[nodiscard]] Picture draw_field(const OccupancyMap& map, const FieldContent& content);

}  // namespace vantage
