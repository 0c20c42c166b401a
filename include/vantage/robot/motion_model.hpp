// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// Limits of a robot's motion and turning, its scan rate and its planning latency. They determine how many seconds
/// a path takes. Speed and acceleration are limited as vectors; turning has its own limits and runs in parallel.
struct MotionModel {
  double max_speed_m_s = 1.0;  ///< largest norm of the velocity, in [1e-3, 1000]
  /// Largest norm of the acceleration vector: speeding up, braking and cornering together, in [1e-3, 10000].
  double max_acceleration_m_s2 = 1.0;
  /// Largest angular rate of the sensor's orientation, about any axis, in [1e-3, 1000].
  double max_yaw_rate_rad_s = 1.0;
  /// Largest angular acceleration, in [1e-3, 10000]; none: the angular rate changes at once.
  std::optional<double> max_yaw_acceleration_rad_s2 = std::nullopt;
  double scan_rate_hz = 10.0;  ///< scans per second, at rest or not, in [1e-2, 1000]
  /// Time from a scan until the robot follows the plan made from it, in [0, 60] seconds. Constant, so that a run does
  /// not depend on the speed of the computer.
  double planning_latency_s = 0.05;

  /// Throws std::invalid_argument naming the field, its value and the rule.
  void validate() const;
  /// How long a straight motion takes from rest to rest, seconds.
  [[nodiscard]] double travel_time_s(double length_m) const;
  /// How long a straight motion takes from `speed_m_s` to rest at its end, seconds. The speed is negative if the
  /// robot moves away from the end; its absolute value is at most `max_speed_m_s`.
  [[nodiscard]] double travel_time_s(double length_m, double speed_m_s) const;
  /// How long a turn takes from rest to rest, seconds.
  [[nodiscard]] double turn_time_s(double angle_rad) const;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/motion_model.ipp>
#endif
