// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/hull_plane.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// An exact, incremental convex hull of cell centres, where cell (x, y, z) is the point (x, y, z). All tests use
/// integer arithmetic. So the result equals the hull of all points, whatever their order, even if many lie in one
/// plane.
///
/// Quickhull on a surface of triangles that is kept from call to call: the cost of an insertion depends on the points
/// outside. A facet is not visible from a new point in its own plane; with exact arithmetic, coplanar points need no
/// other special case. (Barber, Dobkin & Huhdanpaa 1996.)
class LatticeHull {
 public:
  /// A plane that bounds the hull.
  struct Plane {
    std::array<std::int64_t, 3> normal{};  ///< outward normal, divided by its greatest common divisor
    VoxelIndex point;                      ///< a point of the hull in the plane

    /// The plane as a HullPlane, in units of cells.
    [[nodiscard]] HullPlane plane() const;
    /// Whether the planes are equal, even if they are given by different points.
    [[nodiscard]] bool operator==(const Plane& other) const;
  };

  /// Creates an empty hull, which contains no point.
  LatticeHull() = default;
  /// The hull of `points`; empty if they lie in one plane. Coordinates must be within kFurthestVoxel.
  explicit LatticeHull(std::span<const VoxelIndex> points);

  /// Extends the hull by `points`. If the hull is empty, the result is the hull of `points` alone.
  void insert(std::span<const VoxelIndex> points);

  /// Whether the hull is empty.
  [[nodiscard]] bool empty() const { return facets_.empty(); }
  /// Whether a point lies in the hull or on its surface.
  [[nodiscard]] bool contains(const VoxelIndex& point) const;
  /// The number of triangles. It may be above that of the hull of the corners alone, if points were inserted in
  /// the plane of a triangle.
  [[nodiscard]] std::size_t triangle_count() const { return facets_.size() - unused_.size(); }
  /// The planes that bound the hull, each once, sorted by normal.
  [[nodiscard]] std::vector<Plane> planes() const;
  /// The corners of the hull, ascending. Points inside an edge or a plane are not corners.
  [[nodiscard]] std::vector<VoxelIndex> corners() const;

 private:
  using Number = std::uint32_t;
  struct Facet {
    std::array<VoxelIndex, 3> corners{};   // counter-clockwise, seen from outside
    std::array<Number, 3> beside{};        // facets across the edges from each corner to the next
    std::array<std::int64_t, 3> normal{};  // outward, divided by the gcd; zero for an unused facet
  };
  struct Edge {
    VoxelIndex from;
    VoxelIndex to;
    Number behind;  // the facet on the other side, which remains
  };
  struct Outside;

  static Facet facet(const VoxelIndex& a, const VoxelIndex& b, const VoxelIndex& c);
  [[nodiscard]] bool beyond(Number facet, const VoxelIndex& point) const;
  bool start(std::span<const VoxelIndex> points);
  void grow(Outside& outside);
  void replace(Number first_visible, Number point, Outside& outside);
  std::vector<Edge> horizon(std::vector<Number>& visible, Number point, Outside& outside) const;
  std::vector<Number> add_cone(const std::vector<Edge>& rim, const VoxelIndex& apex);
  Number add(const Facet& facet);

  std::vector<Facet> facets_;
  std::vector<Number> unused_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/lattice_hull.ipp>
#endif
