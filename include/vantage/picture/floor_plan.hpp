// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/picture/picture.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a floor plan shows in addition to the map.
struct FloorPlanContent {
  std::string title = {};                       ///< drawn above the picture
  std::vector<Eigen::Vector3d> travelled = {};  ///< successive positions in the world, metres, the start first
  std::vector<Pose> views = {};                 ///< poses of all scans (world_from_sensor), the first scan first
  /// whether to draw a line along the optical axis of each view; useless for a full sphere
  bool show_directions = true;
  std::optional<Pose> next = std::nullopt;  ///< the next view, chosen but not taken yet, in red
  /// Height of a horizontal slice to show, metres; nullopt: all heights, seen from above.
  std::optional<double> slice_z_m = std::nullopt;
};

/// Draws the map from above, +x right and +y up, with the travelled path and the views. If all heights are shown, a
/// column is darker the more of its cells are occupied, and greyer the more are unknown: walls are black, furniture
/// lighter, open floor white. The number of occupied cells of a typical column, floor and ceiling, is subtracted.
/// Throws std::invalid_argument if the map knows no cell.
[[nodiscard]] Picture draw_floor_plan(const OccupancyMap& map, const FloorPlanContent& content);

}  // namespace vantage
