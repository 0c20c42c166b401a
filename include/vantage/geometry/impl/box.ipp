// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/box.hpp>

#include <vantage/geometry/impl/box_distance.hpp>

namespace vantage {

VANTAGE_INLINE double Box::distance_to(const Eigen::Vector3d& point) const {
  return detail::distance_between(*this, point);
}

}  // namespace vantage
