// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vantage/robot/motion_model.hpp>
#include <vantage/robot/trajectory.hpp>

namespace vantage::detail {

/// The time of what no robot can do.
inline constexpr double kNever = std::numeric_limits<double>::infinity();
/// How far apart two places may be by rounding.
inline constexpr double kSamePlaceM = 1e-9;
/// How far a chord may leave a curve.
inline constexpr double kChordM = 1e-4;

/// The state after some seconds of constant acceleration.
[[nodiscard]] inline MotionState moved(const MotionState& from, const Eigen::Vector3d& acceleration, double seconds) {
  return {from.position_m + seconds * from.velocity_m_s + 0.5 * seconds * seconds * acceleration,
          from.velocity_m_s + seconds * acceleration};
}

/// Into how many chords a piece of constant acceleration is to be cut: each is off by acceleration time^2 / 8.
[[nodiscard]] inline int chords_of(double acceleration, double seconds) {
  return std::max(1, static_cast<int>(std::ceil(seconds * std::sqrt(acceleration / (8.0 * kChordM)))));
}

/// The fastest on a straight piece of this length, entered and left at these speeds.
[[nodiscard]] inline double peak_speed(double length, double first, double last, const MotionModel& motion) {
  return std::min(motion.max_speed_m_s, std::sqrt(std::max(0.0, motion.max_acceleration_m_s2 * length +
                                                                    0.5 * (first * first + last * last))));
}

/// The least time of such a piece; kNever where it is too short to brake or to speed up.
[[nodiscard]] inline double straight_time_s(double length, double first, double last, const MotionModel& motion) {
  const double a = motion.max_acceleration_m_s2;
  if (length < -kSamePlaceM || std::abs(first * first - last * last) > 2.0 * a * length + kSamePlaceM) {
    return kNever;
  }
  const double peak = std::max({peak_speed(length, first, last, motion), first, last});
  const double changes = (2.0 * peak * peak - first * first - last * last) / (2.0 * a);
  const double cruise = peak > 0.0 ? std::max(0.0, length - changes) / peak : 0.0;
  return (2.0 * peak - first - last) / a + cruise;
}

}  // namespace vantage::detail
