// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/sim/triangle_mesh.hpp>

namespace VANTAGE_EXPORT vantage {

/// A mesh prepared for ray casts and distances (a bounding volume hierarchy of Embree). All points and directions
/// are in the frame of the mesh, metres. Immutable, safe to use from several threads. Copies share the data.
class TriangleScene {
 public:
  /// Throws std::invalid_argument if a triangle names a vertex that does not exist.
  explicit TriangleScene(const TriangleMesh& mesh);

  /// Distance along the unit vector `direction` to the first surface within `max_distance_m`, metres; none if
  /// there is none.
  [[nodiscard]] std::optional<double> hit_distance(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                                                   double max_distance_m) const;
  /// Distance to the nearest surface, metres, at most `max_distance_m`.
  [[nodiscard]] double distance(const Eigen::Vector3d& point_m, double max_distance_m) const;
  /// Whether a sphere that moves straight from one point to the other touches a surface. Contacts of less than 0.1
  /// mm count as rounding.
  [[nodiscard]] bool touches(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double radius_m) const;

 private:
  struct Embree;
  std::shared_ptr<const Embree> embree_;
};

}  // namespace vantage
