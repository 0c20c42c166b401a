// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/motion_model.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// The robot, as every planner needs it.
struct PlannerSetup {
  RangeSensor sensor;                        ///< sensor model
  std::shared_ptr<const Platform> platform;  ///< the body that carries the sensor; not null
  std::uint64_t seed = 1;                    ///< seed of all random choices
  int threads = 1;                           ///< number of threads, >= 1; does not change the plan
  /// A goal counts as reached if the sensor is within this distance of it, metres, >= 0 (at least one cell is
  /// allowed), and `goal_tolerance_rad` holds.
  double goal_tolerance_m = 0.3;
  /// Allowed angle between the optical axes of the sensor and of the goal, radians, >= 0.
  double goal_tolerance_rad = 0.35;
  /// How fast the robot moves and turns. Used by planners that save time (TourPlanner, which states its default).
  std::optional<MotionModel> motion = std::nullopt;

  /// Throws std::invalid_argument, which names the missing or invalid part.
  void validate() const;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/planner_setup.ipp>
#endif
