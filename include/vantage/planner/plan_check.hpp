// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Whether a plan that is being followed is still worth following.
enum class PlanCheck : std::uint8_t {
  Good,         ///< go on
  WayClosed,    ///< a motion of the rest of the way is not admitted any more
  NothingLeft,  ///< scans on the way have made all known that the plan sought
  OffPath,      ///< the sensor is too far from the path
};

/// Checks a plan against the map as it is now, with the sensor at `current`: what a host asks after every scan on the
/// way, and plans again unless all is Good. `off_path_m` is how far from the path the sensor may be, metres. A plan
/// that is no Move is Good.
[[nodiscard]] PlanCheck check(const Plan& plan, const OccupancyMap& map, const Platform& platform,
                              const Pose& current, double off_path_m = 0.5);

}  // namespace vantage
