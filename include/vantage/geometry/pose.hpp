// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A rigid transform in metres. A pose named `a_from_b` maps coordinates in frame b to coordinates in frame a.
///
/// Frames: **world** has +z up. **sensor** has +z forward along the optical axis, +x right and +y down in the image,
/// as camera drivers and Vasquez-Gomez et al. 2013, V-B, define it. Planners use the pose of the sensor,
/// `world_from_sensor`. A host with another body frame must multiply by its mounting transform.
///
/// The type is unaligned, because the alignment of `Eigen::Isometry3d` depends on the instruction set. A struct that
/// holds one would differ between this library and a host built with `-march=native`. The two types convert into each
/// other.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// Pose (world_from_sensor) of a sensor at `position_m` (world frame, metres). `yaw_rad` is the horizontal direction:
/// 0 is world +x, counter-clockwise seen from above. `pitch_rad` is the tilt; positive looks up. No roll: the image's
/// x axis is horizontal.
[[nodiscard]] Pose pose_looking(const Eigen::Vector3d& position_m, double yaw_rad, double pitch_rad = 0.0);

/// Pose (world_from_sensor) of a sensor at `position_m` with its optical axis along `direction` (any non-zero
/// length), without roll. If the direction is vertical, the image's x axis is world -y.
[[nodiscard]] Pose pose_looking_along(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction);

/// Pose (world_from_sensor) of a sensor at `position_m` that looks horizontally towards `direction`; towards world +x
/// if the direction is vertical.
[[nodiscard]] Pose pose_looking_level(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction);

/// Whether all entries are finite and the linear part is a rotation (orthonormal, determinant +1) within `tolerance`.
[[nodiscard]] bool is_rigid(const Pose& pose, double tolerance = 1e-6);

/// Returns the nearest rigid transform if no entry of its rotation differs by more than 1e-3, for example because the
/// entries were written with three digits. A pose that is already rigid (is_rigid) is returned unchanged. Throws
/// std::invalid_argument if an entry differs by more or is not finite.
[[nodiscard]] Pose orthonormalised(const Pose& pose);

/// The optical axis of a sensor, a unit vector in the world frame.
[[nodiscard]] inline Eigen::Vector3d optical_axis(const Pose& world_from_sensor) {
  return world_from_sensor.linear().col(2);
}

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/pose.ipp>
#endif
