// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A solid ellipsoid.
struct Ellipsoid {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();     ///< the middle, metres
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();     ///< unit directions of the axes, one per column
  Eigen::Vector3d semi_axes_m = Eigen::Vector3d::Zero();  ///< their half lengths, metres, the longest first

  /// Volume, cubic metres.
  [[nodiscard]] double volume_m3() const { return 4.0 / 3.0 * std::numbers::pi * semi_axes_m.prod(); }
  /// Whether a point is inside or on the surface.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_m) const;
  /// The centre and the six ends of the axes: `corners(v)` of Dornhege & Kleiner 2011, IV-C.
  [[nodiscard]] std::array<Eigen::Vector3d, 7> corners() const;
};

}  // namespace vantage
