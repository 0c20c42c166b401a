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

/// Finds the bricks in which the set of cells inside the hull may differ between two hulls.
///
/// A cell that is inside only one hull lies beyond a plane of the other, and this plane is not shared. So only the
/// space beyond unshared planes is searched. The search bisects boxes of bricks and drops a box if no part of it lies
/// beyond an unshared plane, or if all of it lies outside both hulls. A box inside one hull and outside the other is
/// counted as a whole, so that a count costs what the surfaces between the hulls hold, not the space between them.
class HullChange {
 public:
  /// A hull given by its planes, ascending, and its corners.
  struct Hull {
    std::span<const LatticeHull::Plane> planes;
    std::span<const VoxelIndex> corners;
  };
  /// Called with the address of a brick and the cells of it that are inside the new hull. Returns whether it has
  /// counted them itself.
  using Visit = std::function<bool(const VoxelIndex&, const BrickPlane&)>;

  HullChange(const Hull& before, const Hull& now);

  /// Calls `visit` for every such brick of a box of bricks. Returns by how many the cells inside the hull have become
  /// more in those that it has not counted.
  std::int64_t for_each_brick(const VoxelBox& bricks, const Visit& visit);
  /// By how many the cells of a box of bricks inside the hull have become more.
  [[nodiscard]] std::int64_t growth(const VoxelBox& bricks);

 private:
  // The planes of one kind that cut a box, as a range of indices.
  struct Cutting {
    std::size_t first = 0;
    std::size_t last = 0;
    bool beyond = false;  // the whole box lies beyond one of them

    [[nodiscard]] bool empty() const { return first == last; }
  };
  using Planes = std::vector<HullPlane>;

  template <class Whole>
  void visit_box(const VoxelBox& bricks, const Cutting& common, const Cutting& gone, const Cutting& added,
                 const Whole& whole, const Visit& visit);
  template <class Whole>
  void visit_overlap(const VoxelBox& bricks, const Whole& whole, const Visit& visit);
  [[nodiscard]] VoxelBox cells_of(const VoxelBox& bricks) const;
  static Cutting narrow(Planes& planes, const Cutting& from, const VoxelBox& cells);
  [[nodiscard]] BrickPlane inside(const VoxelIndex& brick, const Cutting& common, const Planes& planes,
                                  const Cutting& own) const;

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
