// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// How fast a robot moves, turns, scans and plans: what makes metres and degrees seconds. Speed and acceleration are
/// bounded as vectors, turning by limits of its own; the two go on in parallel.
struct MotionModel {
  double max_speed_m_s = 1.0;  ///< in [1e-3, 1000]
  /// Of speeding up, braking and going round a corner together, in [1e-3, 10000].
  double max_acceleration_m_s2 = 1.0;
  double max_yaw_rate_rad_s =
      1.0;  ///< of the sensor's orientation, about any axis it can turn about, in [1e-3, 1000]
  /// The same of its change, in [1e-3, 10000]; none: a turn starts and ends at once.
  std::optional<double> max_yaw_acceleration_rad_s2 = std::nullopt;
  double scan_rate_hz = 10.0;  ///< scans a second, at rest or not, in [1e-2, 1000]
  /// From the scan that a plan is made from until the robot follows the plan, in [0, 60] seconds. Constant, so that a
  /// run does not depend on who computes it.
  double planning_latency_s = 0.05;

  /// Throws std::invalid_argument naming the field, its value and the rule.
  void validate() const;
  /// How long a straight way takes from rest to rest, seconds.
  [[nodiscard]] double travel_time_s(double length_m) const;
  /// The same for a robot that moves already, at most as fast as it can: at `speed_m_s` along the way, or away from
  /// its end if that is negative.
  [[nodiscard]] double travel_time_s(double length_m, double speed_m_s) const;
  /// How long a turn takes from rest to rest, seconds.
  [[nodiscard]] double turn_time_s(double angle_rad) const;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/motion_model.ipp>
#endif
