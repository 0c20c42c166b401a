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

/// A map at one moment of its growth.
struct GrowthMoment {
  OccupancyMap map = OccupancyMap();            ///< as it was
  std::vector<Eigen::Vector3d> travelled = {};  ///< successive positions until then, metres
  std::string caption = {};                     ///< below the picture: "view 12, 4.7 m"
};

/// Maps from above side by side, all to one scale, with the path up to each moment: how a model grows. `extent` is
/// the part of the world to show; none: all that the last map knows. Throws std::invalid_argument if there is no
/// moment, or nothing to show.
[[nodiscard]] Picture draw_growth_strip(std::span<const GrowthMoment> moments, const std::string& title,
                                        const std::optional<Box>& extent = std::nullopt);

}  // namespace vantage
