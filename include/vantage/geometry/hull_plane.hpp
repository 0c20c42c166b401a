// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// A plane that bounds a convex hull, in the unit of its points. The signed distance of a point p is
/// normal . p + offset; it is <= 0 inside the hull.
struct HullPlane {
  /// Unit normal, pointing outward.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// Signed distance of the origin from the plane.
  double offset = 0.0;
};

}  // namespace vantage
