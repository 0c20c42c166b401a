// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/geometry/ellipsoid.hpp>

namespace vantage {

VANTAGE_INLINE bool Ellipsoid::contains(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d along = axes.transpose() * (point_m - centre_m);
  return along.cwiseQuotient(semi_axes_m).squaredNorm() <= 1.0;
}

VANTAGE_INLINE std::array<Eigen::Vector3d, 7> Ellipsoid::corners() const {
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

}  // namespace vantage
