// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/vision/picture.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A snapshot of a growing map.
struct GrowthMoment {
  OccupancyMap map = OccupancyMap();            ///< the map at that time
  std::vector<Eigen::Vector3d> travelled = {};  ///< successive positions up to that time, metres
  std::string caption = {};                     ///< drawn below the picture, for example "view 12, 4.7 m"
};

/// Draws maps from above side by side, at the same scale, each with the path up to its time. `extent` is the region
/// to show; nullopt: everything that the last map knows. Throws std::invalid_argument if there is no snapshot or
/// nothing to show.
[[nodiscard]] Picture draw_growth_strip(std::span<const GrowthMoment> moments, const std::string& title,
                                        const std::optional<Box>& extent = std::nullopt);

}  // namespace vantage
