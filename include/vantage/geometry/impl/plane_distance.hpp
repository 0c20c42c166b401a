// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/hull_plane.hpp>

namespace vantage::detail {

/// Signed distance of a point from the plane of a facet, in the unit of the hull; negative inside.
[[nodiscard]] inline double distance_from(const HullPlane& plane, const Eigen::Vector3d& point) {
  return plane.normal.dot(point) + plane.offset;
}

}  // namespace vantage::detail
