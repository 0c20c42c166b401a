// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A rigid transform, named `a_from_b`: it takes coordinates in frame b to coordinates in frame a, in metres.
///
/// The frames of this library: **world** has +z up; **sensor** has +z forward along the optical axis, +x right and
/// +y down in the image (Vasquez-Gomez et al. 2013, V-B, and every camera driver). A planner speaks of the pose of
/// the sensor, `world_from_sensor`; a host with another body frame multiplies by its own mounting transform.
///
/// Unaligned: an `Eigen::Isometry3d` is as aligned as the instruction set that a file is compiled for, so a struct
/// that holds one differs between a host built with `-march=native` and this library. The two convert into each
/// other.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// The sensor at `position_m`, looking level along `yaw_rad` (0 = world +x, counter-clockwise seen from above), then
/// tilted up by `pitch_rad` (positive looks up). No roll: the image's x axis stays horizontal.
[[nodiscard]] Pose pose_looking(const Eigen::Vector3d& position_m, double yaw_rad, double pitch_rad = 0.0);

/// The sensor at `position_m` with its optical axis along `direction` (any non-zero length), without roll. Straight
/// up or down, where "without roll" has no meaning, the image's x axis is world -y.
[[nodiscard]] Pose pose_looking_along(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction);

/// The sensor at `position_m`, level, turned to where `direction` points; to world +x if that is straight up or down.
[[nodiscard]] Pose pose_looking_level(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction);

/// Whether every entry is finite and the linear part is a rotation (orthonormal, determinant +1) within `tolerance`.
[[nodiscard]] bool is_rigid(const Pose& pose, double tolerance = 1e-6);

/// The rigid transform nearest to one whose rotation is off by up to 1e-3, as one written with four digits is; one
/// that is rigid (is_rigid) comes back as it is. Throws std::invalid_argument if it is further off or not finite.
[[nodiscard]] Pose orthonormalised(const Pose& pose);

/// The optical axis of `world_from_sensor`, a unit vector in the world frame.
[[nodiscard]] inline Eigen::Vector3d optical_axis(const Pose& world_from_sensor) {
  return world_from_sensor.linear().col(2);
}

}  // namespace vantage
