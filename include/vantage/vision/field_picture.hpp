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

/// A potential field and what is drawn with it. The spans must be valid during the call.
struct FieldContent {
  std::string title = {};                     ///< drawn above the picture
  std::span<const VoxelIndex> cells = {};     ///< cells of the field, in any order
  std::span<const double> phi = {};           ///< potential of each of `cells`: 1 at the sensor, 0 at the frontier
  std::span<const VoxelIndex> frontier = {};  ///< frontier cells, where the potential is 0
  /// path of steepest descent from the sensor, metres; may be empty
  std::span<const Eigen::Vector3d> streamline = {};
  Eigen::Vector3d sensor_m = Eigen::Vector3d::Zero();  ///< position of the sensor, metres
  std::optional<Box> extent = std::nullopt;            ///< region to show; nullopt: everything known
  /// Height of the slice, metres; nullopt: height of the sensor.
  std::optional<double> slice_z_m = std::nullopt;
};

/// Draws a horizontal slice of the field: the potential as colours, arrows along the negative gradient, the frontier
/// cells of the slice in red, the streamline (all heights) in white, and walls in black. Colours show the *rank* of
/// phi in the slice, because phi falls steeply near the sensor and is nearly constant elsewhere. The colour bar shows
/// the values. Throws std::invalid_argument if `cells` and `phi` differ in length, the extent is empty, or there is
/// neither an extent nor a known cell.
[[nodiscard]] Picture draw_field(const OccupancyMap& map, const FieldContent& content);

}  // namespace vantage
