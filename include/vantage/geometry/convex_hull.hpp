// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The smallest convex body that holds a set of points, by Quickhull (Barber, Dobkin & Huhdanpaa 1996).
class ConvexHull {
 public:
  /// A facet's plane: `normal` (unit, outward) . p + `offset` is the signed distance of p, <= 0 inside.
  struct Plane {
    /// Unit normal, outward.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    /// Signed distance of the origin from the plane, metres.
    double offset = 0.0;
  };

  /// An empty hull, which holds nothing.
  ConvexHull() = default;
  /// The hull of `points`. Points without volume (fewer than four, or all in one plane) give an empty hull, with the
  /// reason. Throws std::invalid_argument if a coordinate is not finite.
  explicit ConvexHull(const std::vector<Eigen::Vector3d>& points);

  /// Whether there is no hull.
  [[nodiscard]] bool empty() const { return planes_.empty(); }
  /// Why the hull is empty; empty where it is not.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// The planes that bound it.
  [[nodiscard]] const std::vector<Plane>& planes() const { return planes_; }
  /// Those of the points that span it: their hull is the same. None where it is empty.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& corners() const { return corners_; }
  /// Whether `point` lies in the hull or at most `tolerance` beyond one of its planes.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point, double tolerance = 1e-9) const;

 private:
  std::vector<Plane> planes_;
  std::vector<Eigen::Vector3d> corners_;
  std::string reason_ = "there are no points";
};

}  // namespace vantage
