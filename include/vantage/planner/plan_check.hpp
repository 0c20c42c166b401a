// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Whether a plan that is being followed is still valid.
enum class PlanCheck : std::uint8_t {
  Good,         ///< continue
  WayClosed,    ///< a motion of the rest of the path is not admitted any more
  NothingLeft,  ///< all cells that the plan sought are known, and none is contested
  OffPath,      ///< the sensor is too far from the path
};

/// Checks a plan against the current map, with the sensor at `current` (world_from_sensor). A host calls it after
/// each scan on the way, and plans again unless the result is Good. `off_path_m` is the allowed distance from the
/// path, metres. A plan whose outcome is not Move is Good.
[[nodiscard]] PlanCheck check(const Plan& plan, const OccupancyMap& map, const Platform& platform,
                              const Pose& current, double off_path_m = 0.5);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/plan_check.ipp>
#endif
