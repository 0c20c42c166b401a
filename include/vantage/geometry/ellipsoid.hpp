// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <numbers>

namespace vantage {

/// A solid ellipsoid.
struct Ellipsoid {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();     ///< the middle, metres
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();     ///< unit directions of the axes, one per column
  Eigen::Vector3d semi_axes_m = Eigen::Vector3d::Zero();  ///< their half lengths, metres, the longest first

  /// Volume, cubic metres.
  [[nodiscard]] double volume_m3() const { return 4.0 / 3.0 * std::numbers::pi * semi_axes_m.prod(); }
  /// Whether a point is inside or on the surface.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3d along = axes.transpose() * (point_m - centre_m);
    return along.cwiseQuotient(semi_axes_m).squaredNorm() <= 1.0;
  }
  /// The centre and the six ends of the axes: `corners(v)` of Dornhege & Kleiner 2011, IV-C.
  [[nodiscard]] std::array<Eigen::Vector3d, 7> corners() const {
    std::array<Eigen::Vector3d, 7> all;
    all[0] = centre_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const Eigen::Vector3d reach = semi_axes_m[i] * axes.col(i);
      all[1 + 2 * axis] = centre_m + reach;
      all[2 + 2 * axis] = centre_m - reach;
    }
    return all;
  }
};

}  // namespace vantage
