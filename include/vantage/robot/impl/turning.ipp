// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vantage/robot/turning.hpp>

namespace vantage {
namespace detail {

// From one orientation to the other as an axis in the world times the angle about it, in [0, pi].
inline Eigen::Vector3d turn_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  return turn.angle() * turn.axis();
}

inline Eigen::Quaterniond turned_by(const Eigen::Quaterniond& from, const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  return angle > 0.0 ? (Eigen::AngleAxisd(angle, turn / angle) * from).normalized() : from;
}

}  // namespace detail

VANTAGE_INLINE Turning::Turning(const Eigen::Matrix3d& orientation) : orientation_(Eigen::Quaterniond(orientation)) {}

VANTAGE_INLINE Eigen::Matrix3d Turning::orientation() const {
  return Eigen::Quaterniond(orientation_).toRotationMatrix();
}

VANTAGE_INLINE double Turning::angle_to_rad(const Eigen::Matrix3d& other) const {
  return detail::turn_between(Eigen::Quaterniond(orientation_), Eigen::Quaterniond(other)).norm();
}

VANTAGE_INLINE void Turning::advance(const Eigen::Matrix3d& target, double step_s, const MotionModel& motion) {
  const Eigen::Quaterniond goal(target);
  const Eigen::Quaterniond now(orientation_);
  const Eigen::Vector3d left = detail::turn_between(now, goal);
  const double angle = left.norm();
  // In one step at rest at the goal: always admitted without a limit of the acceleration.
  const bool arrives = angle <= motion.max_yaw_rate_rad_s * step_s;
  if (!motion.max_yaw_acceleration_rad_s2) {
    rate_rad_s_ = arrives ? Eigen::Vector3d::Zero() : Eigen::Vector3d(left * (motion.max_yaw_rate_rad_s / angle));
    orientation_ = arrives ? goal : detail::turned_by(now, rate_rad_s_ * step_s);
    return;
  }
  const double acceleration = *motion.max_yaw_acceleration_rad_s2;
  const double change = acceleration * step_s;
  if (arrives && angle <= change * step_s && rate_rad_s_.norm() <= change) {
    rate_rad_s_.setZero();
    orientation_ = goal;
    return;
  }
  // The fastest that can still brake in time after this step: rate * step + rate^2 / (2 acceleration) = angle.
  const double brakes_in_time = acceleration * (std::sqrt(step_s * step_s + 2.0 * angle / acceleration) - step_s);
  const Eigen::Vector3d wanted =
      left * (std::min(brakes_in_time, motion.max_yaw_rate_rad_s) / std::max(angle, 1e-12));
  const Eigen::Vector3d difference = wanted - rate_rad_s_;
  rate_rad_s_ += difference * std::min(1.0, change / std::max(difference.norm(), 1e-12));
  orientation_ = detail::turned_by(now, rate_rad_s_ * step_s);
}

}  // namespace vantage
