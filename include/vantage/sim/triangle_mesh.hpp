// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Surfaces as triangles, in metres, z up. Both sides of a triangle are solid to a sensor: the winding says nothing.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;                ///< points, metres
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< three positions in `vertices` each

  /// The smallest box whose closure holds every vertex of a triangle; empty for an empty mesh.
  [[nodiscard]] Box bounds() const;
  /// Adds the triangles of `other`, scaled about its origin and then moved by `this_from_other`.
  void append(const TriangleMesh& other, const Pose& this_from_other = Pose::Identity(), double scale = 1.0);
  /// Adds the quadrilateral a, b, c, d (in order around it) as two triangles.
  void add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);
  /// Adds the six faces of a box.
  void add_box(const Box& box);
};

/// The faces between solid and empty cells of a grid (what lies outside it is solid where `outside_solid`), each
/// moved `inset_m` into its solid cell. Without an inset every surface would lie on the border of two cells, where
/// rounding alone decides which of them a ray ends in.
[[nodiscard]] TriangleMesh surface_of_cells(const VoxelGrid<std::uint8_t>& solid, const VoxelFrame& frame,
                                            double inset_m, bool outside_solid = true);

}  // namespace vantage
