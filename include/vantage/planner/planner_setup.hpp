// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// What every planner needs to know of the robot.
struct PlannerSetup {
  RangeSensor sensor;                        ///< what it sees
  std::shared_ptr<const Platform> platform;  ///< what carries it; never null
  std::uint64_t seed = 1;                    ///< of everything random
  int threads = 1;                           ///< > 0; never changes the plan
  /// A goal counts as reached when the sensor is no further from it than this, metres, >= 0 (a cell at least), ...
  double goal_tolerance_m = 0.3;
  /// ... and its optical axis is turned by no more than this from the goal's, radians, >= 0.
  double goal_tolerance_rad = 0.35;

  /// Throws std::invalid_argument naming what is missing or breaks its rule.
  void validate() const;
};

}  // namespace vantage
