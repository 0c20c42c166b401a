// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A solid ellipsoid in the world frame.
struct Ellipsoid {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();     ///< centre, metres
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();     ///< unit directions, one per column, longest axis first
  Eigen::Vector3d semi_axes_m = Eigen::Vector3d::Zero();  ///< half axes, metres, longest first

  /// Volume, cubic metres.
  [[nodiscard]] double volume_m3() const { return 4.0 / 3.0 * std::numbers::pi * semi_axes_m.prod(); }
  /// Whether a point (metres) is inside or on the surface.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_m) const;
  /// The centre and the six end points of the axes, metres: `corners(v)` of Dornhege & Kleiner 2011, IV-C.
  [[nodiscard]] std::array<Eigen::Vector3d, 7> corners() const;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/ellipsoid.ipp>
#endif
