// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The convex hull of a set of points, computed by Quickhull (Barber, Dobkin & Huhdanpaa 1996). All lengths are in
/// the unit of the points.
class ConvexHull {
 public:
  /// The plane of a facet. The signed distance of a point p is normal . p + offset; it is <= 0 inside the hull.
  struct Plane {
    /// Unit normal, pointing outward.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    /// Signed distance of the origin from the plane.
    double offset = 0.0;
  };

  /// Creates an empty hull, which contains no point.
  ConvexHull() = default;
  /// The hull of `points`. It is empty, with a reason, if the points span no volume: fewer than four points, or all
  /// in one plane. Throws std::invalid_argument if a coordinate is not finite, std::runtime_error if no temporary
  /// file can be opened.
  explicit ConvexHull(const std::vector<Eigen::Vector3d>& points);

  /// Whether the hull is empty.
  [[nodiscard]] bool empty() const { return planes_.empty(); }
  /// Why the hull is empty; an empty text if it is not.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  /// The planes of all facets.
  [[nodiscard]] const std::vector<Plane>& planes() const { return planes_; }
  /// The points that are corners of the hull. None if the hull is empty.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& corners() const { return corners_; }
  /// Whether `point` lies in the hull, or at most `tolerance` beyond each of its planes.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point, double tolerance = 1e-9) const;

 private:
  std::vector<Plane> planes_;
  std::vector<Eigen::Vector3d> corners_;
  std::string reason_ = "there are no points";
};

}  // namespace vantage
