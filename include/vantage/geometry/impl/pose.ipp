// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>
#include <vantage/geometry/pose.hpp>

namespace vantage {

VANTAGE_INLINE Pose pose_looking(const Eigen::Vector3d& position_m, double yaw_rad, double pitch_rad) {
  const double level = std::cos(pitch_rad);
  const Eigen::Vector3d forward(level * std::cos(yaw_rad), level * std::sin(yaw_rad), std::sin(pitch_rad));
  const Eigen::Vector3d right(std::sin(yaw_rad), -std::cos(yaw_rad), 0.0);
  Pose world_from_sensor = Pose::Identity();
  world_from_sensor.linear().col(0) = right;
  world_from_sensor.linear().col(1) = forward.cross(right);
  world_from_sensor.linear().col(2) = forward;
  world_from_sensor.translation() = position_m;
  return world_from_sensor;
}

VANTAGE_INLINE Pose pose_looking_along(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) {
  const double level = std::hypot(direction.x(), direction.y());
  const double yaw_rad = level > 1e-12 * std::abs(direction.z()) ? std::atan2(direction.y(), direction.x()) : 0.0;
  return pose_looking(position_m, yaw_rad, std::atan2(direction.z(), level));
}

VANTAGE_INLINE Pose pose_looking_level(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) {
  const bool has_heading = std::hypot(direction.x(), direction.y()) > 1e-9;
  return pose_looking(position_m, has_heading ? std::atan2(direction.y(), direction.x()) : 0.0);
}

VANTAGE_INLINE bool is_rigid(const Pose& pose, double tolerance) {
  if (!pose.matrix().allFinite()) {
    return false;
  }
  const Eigen::Matrix3d rotation = pose.linear();
  return (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance &&
         rotation.determinant() > 0.0;
}

VANTAGE_INLINE Pose orthonormalised(const Pose& pose) {
  if (is_rigid(pose)) {
    return pose;
  }
  if (pose.matrix().allFinite()) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> parts(pose.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    Pose rigid = pose;
    rigid.linear() = parts.matrixU() * parts.matrixV().transpose();
    if (rigid.linear().determinant() > 0.0 && (rigid.linear() - pose.linear()).cwiseAbs().maxCoeff() <= 1e-3) {
      return rigid;
    }
  }
  throw std::invalid_argument("the pose is not a rigid transform");
}

}  // namespace vantage
