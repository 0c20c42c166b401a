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

/// Surfaces as triangles; metres, z up. Both sides stop a ray; the winding does not matter to a sensor.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;                ///< positions, metres
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< three indices into `vertices` each

  /// The smallest box whose closure holds every vertex that a triangle uses; empty for an empty mesh.
  [[nodiscard]] Box bounds() const;
  /// Adds the triangles of `other`, scaled about its origin, then moved by `this_from_other`.
  void append(const TriangleMesh& other, const Pose& this_from_other = Pose::Identity(), double scale = 1.0);
  /// Adds the quadrilateral a, b, c, d (in order around it) as two triangles.
  void add_quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);
  /// Adds the six faces of a box.
  void add_box(const Box& box);
};

/// Makes the faces between solid and empty cells of a grid, each moved `inset_m` metres into its solid cell. What
/// lies outside the grid is solid if `outside_solid`. Without an inset a surface lies on the border of two cells,
/// and rounding decides in which of them a ray ends.
[[nodiscard]] TriangleMesh surface_of_cells(const VoxelGrid<std::uint8_t>& solid, const VoxelFrame& frame,
                                            double inset_m, bool outside_solid = true);

}  // namespace vantage
