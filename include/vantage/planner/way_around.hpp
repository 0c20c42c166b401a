// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A way between two views of an object: straight, or an arc about its middle where the platform can go that way, for
/// that is soon known; else by the platform's own search. None if it finds none.
[[nodiscard]] std::optional<std::vector<Pose>> way_around(const OccupancyMap& map, const Platform& platform,
                                                          const Pose& from, const Pose& to,
                                                          const Eigen::Vector3d& middle);

}  // namespace vantage
