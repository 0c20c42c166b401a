// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/lattice_hull.hpp>
#include <vector>

namespace vantage::detail {

/// Finds the bricks in which the set of cells inside the hull may differ between two hulls, and counts by how much.
///
/// A cell that is inside only one hull lies beyond a plane of the other, and this plane is not shared. So only the
/// space beyond unshared planes is searched. The search bisects boxes of bricks and drops a box if no part of it lies
/// beyond an unshared plane, or if all of it lies outside both hulls.
///
/// Where cells are only counted, it bisects across the surfaces, not along them, and counts bars of bricks by rows of
/// cells. A row is cut by planes, whatever its length:
///
///      old hull          new corner            |  |  |  |    bars; between the surfaces, a wedge that
///     --------------.___     o                 |  |  |  |    is long and thin holds few rows
///                       ---.___  the wedge    _|__|__|__|___ new surface
///                              ---.____       -|--|--|--|--- old surface
///
/// A box inside one hull and outside the other is counted as a whole.
class HullChange {
 public:
  /// A hull given by its planes, ascending, and its corners.
  struct Hull {
    std::span<const LatticeHull::Plane> planes;
    std::span<const VoxelIndex> corners;
  };
  /// Called with the address of a brick and the cells of it that are inside the new hull.
  using Visit = std::function<void(const VoxelIndex&, const BrickPlane&)>;
  /// Whether a box of bricks holds one that is to be visited.
  using Holds = std::function<bool(const VoxelBox&)>;

  HullChange(const Hull& before, const Hull& now);

  /// Calls `visit` for every such brick of a box of bricks.
  void for_each_brick(const VoxelBox& bricks, const Visit& visit);
  /// Calls `visit` for the bricks of a box for which `holds` is true. Returns by how many cells the hull has
  /// grown in the other bricks.
  [[nodiscard]] std::int64_t growth(const VoxelBox& bricks, const Holds& holds, const Visit& visit);

 private:
  // The planes of one kind that cut a box, as a range of indices.
  struct Cutting {
    std::size_t first = 0;
    std::size_t last = 0;
    bool beyond = false;                               // the whole box lies beyond one of them
    Eigen::Vector3d slopes = Eigen::Vector3d::Zero();  // sum of their normals, without signs

    [[nodiscard]] bool empty() const { return first == last; }
  };
  using Planes = std::vector<HullPlane>;

  void visit_box(const VoxelBox& bricks, const Cutting& common, const Cutting& gone, const Cutting& added,
                 const Holds& holds, const Visit& visit);
  void count_rows(const VoxelBox& cells, std::size_t axis, const Cutting& common, const Cutting& gone,
                  const Cutting& added);
  [[nodiscard]] VoxelBox cells_of(const VoxelBox& bricks) const;
  static Cutting narrow(Planes& planes, const Cutting& from, const VoxelBox& cells);
  static std::span<const HullPlane> of(const Planes& planes, const Cutting& cutting);
  [[nodiscard]] BrickPlane inside(const VoxelIndex& brick, const Cutting& common, const Cutting& added) const;

  VoxelBox cells_;  // around both hulls
  std::int64_t growth_ = 0;
  // Three stacks. Each recursion pushes the planes that cut its box, and removes them when it returns.
  Planes common_;
  Planes gone_;
  Planes added_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/hull_change.ipp>
#endif
