// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/lattice_hull.hpp>
#include <vector>

namespace vantage::detail {

/// From one hull to another: the bricks in which that may have changed what is inside. A cell that only one of them
/// holds lies beyond a plane of the other that is none of its own, so all is left alone but what lies beyond planes
/// that only one of them has.
class HullChange {
 public:
  /// A hull: its planes, ascending, and its corners.
  struct Hull {
    std::span<const LatticeHull::Plane> planes;
    std::span<const VoxelIndex> corners;
  };
  /// Called with the address of a brick and its cells inside the hull now.
  using Visit = std::function<void(const VoxelIndex&, const BrickPlane&)>;

  HullChange(const Hull& before, const Hull& now);

  /// Visits every such brick of some tiles (VoidTiles), all different, once.
  void for_each_brick(std::span<const VoxelIndex> tiles, const Visit& visit);

 private:
  // The planes that matter to a box of bricks, as positions in those of each kind.
  struct Cutting {
    std::size_t first = 0;
    std::size_t last = 0;
    bool beyond = false;  // the whole box lies beyond one of them

    [[nodiscard]] bool empty() const { return first == last; }
  };
  using Planes = std::vector<ConvexHull::Plane>;

  void visit_box(const VoxelBox& bricks, const Cutting& common, const Cutting& gone, const Cutting& added,
                 const Visit& visit);
  static Cutting narrow(Planes& planes, const Cutting& from, const VoxelBox& bricks);
  [[nodiscard]] BrickPlane inside(const VoxelIndex& brick, const Cutting& common, const Cutting& added) const;

  VoxelBox bricks_;
  // A stack each: a box adds those that matter to it, and takes them off again.
  Planes common_;
  Planes gone_;
  Planes added_;
};

}  // namespace vantage::detail
