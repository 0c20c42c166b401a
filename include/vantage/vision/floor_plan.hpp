// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/picture.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a floor plan shows besides the map.
struct FloorPlanContent {
  std::string title = {};                       ///< above the picture
  std::vector<Eigen::Vector3d> travelled = {};  ///< successive positions in the world, metres; the start first
  std::vector<Pose> views = {};                 ///< world_from_sensor of every scan, the first scan first
  bool show_directions = true;  ///< a short stroke along each view's optical axis (senseless for a full sphere)
  std::optional<Pose> next = std::nullopt;  ///< a view that was chosen and is still to be taken, in red
  /// The part of the world to show; none: all that is known. Its heights matter too: only cells in it are drawn.
  std::optional<Box> extent = std::nullopt;
  /// Height of the horizontal slice to show, metres; none: the whole height seen from above.
  std::optional<double> slice_z_m = std::nullopt;
};

/// The map seen from above, +x to the right and +y up, with the path travelled and the views taken. Seen through the
/// whole height, a column is the darker the more of it is occupied, and the greyer the more of it is unknown: walls
/// are black, furniture lighter, open floor white; as many cells as the usual column holds for floor and ceiling do
/// not count. Throws std::invalid_argument if the extent is empty or if there is neither an extent nor a known cell.
[[nodiscard]] Picture draw_floor_plan(const OccupancyMap& map, const FloorPlanContent& content);

}  // namespace vantage
