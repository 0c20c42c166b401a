// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/convex_hull.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The convex hull of cells' centres that grows with them: cell (x, y, z) is the point (x, y, z). All is decided in
/// integers, so that no order of cells and no wall of cells in one plane can make it differ from the hull of all.
///
/// Quickhull (Barber, Dobkin & Huhdanpaa 1996) on a surface of triangles that stays from call to call: growing costs
/// what lies outside. A triangle in whose plane a new point lies is not visible from there, which is all that exact
/// arithmetic needs to say about points in one plane.
class LatticeHull {
 public:
  /// A plane that bounds it.
  struct Plane {
    std::array<std::int64_t, 3> normal{};  ///< outward, without common divisor
    VoxelIndex point;                      ///< a point of the hull that lies in it

    /// The same in metres where a cell is one metre wide.
    [[nodiscard]] ConvexHull::Plane plane() const;
    /// The same plane, whatever point it is given by.
    [[nodiscard]] bool operator==(const Plane& other) const;
  };

  /// An empty hull, which holds nothing.
  LatticeHull() = default;
  /// The hull of these; empty where they lie in one plane. None may be further off than kFurthestVoxel.
  explicit LatticeHull(std::span<const VoxelIndex> points);

  /// Grows it by what of these lies outside; an empty hull becomes that of `points` alone.
  void insert(std::span<const VoxelIndex> points);

  /// Whether there is no hull.
  [[nodiscard]] bool empty() const { return facets_.empty(); }
  /// Whether a point lies in it.
  [[nodiscard]] bool contains(const VoxelIndex& point) const;
  /// The planes that bound it, each once, ascending by their normals.
  [[nodiscard]] std::vector<Plane> planes() const;
  /// The points that span it, none of them in the hull of the others, ascending.
  [[nodiscard]] std::vector<VoxelIndex> corners() const;

 private:
  using Number = std::uint32_t;
  struct Facet {
    std::array<VoxelIndex, 3> corners{};   // counter-clockwise from outside
    std::array<Number, 3> beside{};        // across the edges from each corner to the next
    std::array<std::int64_t, 3> normal{};  // outward, without common divisor; zero where the facet is none any more
  };
  struct Edge {
    VoxelIndex from;
    VoxelIndex to;
    Number behind;  // the facet on the other side, which stays
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
