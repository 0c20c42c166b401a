// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <vantage/robot/motion_model.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline void require_limit(double value, double least, double most, const char* field, const char* rule) {
  detail::require_option(value >= least && value <= most, field, value, rule);  // NaN holds to no rule
}

// Speeds up as long as it can, and brakes as long as it must.
inline double rest_to_rest_s(double way, double rate, double acceleration) {
  return way < rate * rate / acceleration ? 2.0 * std::sqrt(way / acceleration) : way / rate + rate / acceleration;
}

}  // namespace detail

VANTAGE_INLINE void MotionModel::validate() const {
  detail::require_limit(max_speed_m_s, 1e-3, 1e3, "MotionModel::max_speed_m_s", "in [0.001, 1000]");
  detail::require_limit(max_acceleration_m_s2, 1e-3, 1e4, "MotionModel::max_acceleration_m_s2", "in [0.001, 10000]");
  detail::require_limit(max_yaw_rate_rad_s, 1e-3, 1e3, "MotionModel::max_yaw_rate_rad_s", "in [0.001, 1000]");
  detail::require_limit(max_yaw_acceleration_rad_s2.value_or(1.0), 1e-3, 1e4,
                        "MotionModel::max_yaw_acceleration_rad_s2", "in [0.001, 10000]");
  detail::require_limit(scan_rate_hz, 1e-2, 1e3, "MotionModel::scan_rate_hz", "in [0.01, 1000]");
  detail::require_limit(planning_latency_s, 0.0, 60.0, "MotionModel::planning_latency_s", "in [0, 60]");
}

VANTAGE_INLINE double MotionModel::travel_time_s(double length_m) const {
  return detail::rest_to_rest_s(length_m, max_speed_m_s, max_acceleration_m_s2);
}

VANTAGE_INLINE double MotionModel::travel_time_s(double length_m, double speed_m_s) const {
  const double acceleration = max_acceleration_m_s2;
  const double braked_m = 0.5 * speed_m_s * std::abs(speed_m_s) / acceleration;
  if (speed_m_s < 0.0 || braked_m > length_m) {  // it stops first, and comes back
    return std::abs(speed_m_s) / acceleration + travel_time_s(std::abs(length_m - braked_m));
  }
  // As if it had started from rest, further back.
  return travel_time_s(length_m + braked_m) - speed_m_s / acceleration;
}

VANTAGE_INLINE double MotionModel::turn_time_s(double angle_rad) const {
  return detail::rest_to_rest_s(angle_rad, max_yaw_rate_rad_s,
                                max_yaw_acceleration_rad_s2.value_or(std::numeric_limits<double>::infinity()));
}

}  // namespace vantage
