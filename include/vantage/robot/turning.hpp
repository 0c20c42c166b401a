// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vantage/compiler.hpp>
#include <vantage/robot/motion_model.hpp>

namespace VANTAGE_EXPORT vantage {

/// The orientation of a sensor while it turns towards given orientations, by the smaller angle and within the
/// limits of a MotionModel. Turning does not depend on the position.
class Turning {
 public:
  /// Starts at rest with this orientation (world_from_sensor).
  explicit Turning(const Eigen::Matrix3d& orientation);

  /// Turns towards `target` for `step_s` seconds, > 0; the turn brakes in time to come to rest there. The
  /// rate and its change within a step stay within their limits. A turn takes MotionModel::turn_time_s, to within one
  /// step if the angular acceleration is not limited, and four steps if it is.
  void advance(const Eigen::Matrix3d& target, double step_s, const MotionModel& motion);

  /// The current orientation (rotation of world_from_sensor).
  [[nodiscard]] Eigen::Matrix3d orientation() const;
  /// Angle between the current orientation and another, radians.
  [[nodiscard]] double angle_to_rad(const Eigen::Matrix3d& other) const;
  /// The angular velocity now, as a vector in the world, radians per second.
  [[nodiscard]] const Eigen::Vector3d& rate_rad_s() const { return rate_rad_s_; }

 private:
  Eigen::Quaternion<double, Eigen::DontAlign> orientation_;
  Eigen::Vector3d rate_rad_s_ = Eigen::Vector3d::Zero();
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/robot/impl/turning.ipp>
#endif
