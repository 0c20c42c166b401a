// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/lattice_hull.hpp>
#include <vector>

namespace vantage::detail {

/// Finds the bricks in which the set of cells inside the hull may differ between two hulls.
///
/// A cell that is inside only one hull lies beyond a plane of the other, and this plane is not shared. So only the
/// space beyond unshared planes is searched. The search bisects boxes of bricks and drops a box if no part of it lies
/// beyond an unshared plane, or if all of it lies outside both hulls.
class HullChange {
 public:
  /// A hull given by its planes, ascending, and its corners.
  struct Hull {
    std::span<const LatticeHull::Plane> planes;
    std::span<const VoxelIndex> corners;
  };
  /// Called with the address of a brick and the cells of it that are inside the new hull.
  using Visit = std::function<void(const VoxelIndex&, const BrickPlane&)>;

  HullChange(const Hull& before, const Hull& now);

  /// Calls `visit` once for every such brick in the given tiles (VoidTiles). The tiles must be distinct.
  void for_each_brick(std::span<const VoxelIndex> tiles, const Visit& visit);

 private:
  // The planes of one kind that cut a box, as a range of indices.
  struct Cutting {
    std::size_t first = 0;
    std::size_t last = 0;
    bool beyond = false;  // the whole box lies beyond one of them

    [[nodiscard]] bool empty() const { return first == last; }
  };
  using Planes = std::vector<HullPlane>;

  void visit_box(const VoxelBox& bricks, const Cutting& common, const Cutting& gone, const Cutting& added,
                 const Visit& visit);
  static Cutting narrow(Planes& planes, const Cutting& from, const VoxelBox& bricks);
  [[nodiscard]] BrickPlane inside(const VoxelIndex& brick, const Cutting& common, const Cutting& added) const;

  VoxelBox bricks_;
  // Three stacks. Each recursion pushes the planes that cut its box, and removes them when it returns.
  Planes common_;
  Planes gone_;
  Planes added_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/frontier/impl/hull_change.ipp>
#endif
