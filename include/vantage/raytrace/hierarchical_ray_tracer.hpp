// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/ray_tree.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What hierarchical ray tracing counts of a view: rays, not cells, and so more than there are cells.
struct HierarchicalCounts {
  std::size_t occupied = 0;  ///< rays of the finest level that end in an occupied cell
  std::size_t unknown = 0;   ///< rays of the finest level below those, of any level, that end in an unknown cell
  std::size_t casts = 0;     ///< rays that were cast

  /// The same counts.
  friend bool operator==(const HierarchicalCounts&, const HierarchicalCounts&) = default;
};

/// Hierarchical ray tracing, Algorithm 2 of Vasquez-Gomez et al. 2013, over any map: rays of the tree's first level
/// are cast first; where one ends in an occupied cell its children are cast in the next finer map, down to the
/// finest; where one ends in an unknown cell the rays that depend on it are counted and it is left at that.
///
/// `cast(level, direction)` casts a ray of a level of the tree, by its direction in the sensor frame, in the map of
/// that level. It returns what the ray ends in as far as that is to count: Free otherwise, which is neither counted
/// nor refined. A tree is a RayTree, or anything with its `rays`, `children` and `leaves`.
template <class Tree, class Cast>
[[nodiscard]] HierarchicalCounts trace_hierarchically(const Tree& tree, const Cast& cast);

/// How a HierarchicalRayTracer works.
struct HierarchicalRayTracerOptions {
  /// How many resolutions there are from the first to the finest, in [1, 16]; the paper's start depth of 14 in an
  /// octree of depth 16 is 3. With 1 it is uniform ray tracing.
  int levels = 4;
  /// How a coarser cell speaks for the finest ones in it (V-A.1).
  CoarseningPolicy policy = CoarseningPolicy::Max;
  /// Whether occupied cells outside the object box are refined as well, as the paper's algorithm has it. They cannot
  /// count; but what is behind an occupied cell that turns out to be mostly free is not seen where they are not.
  bool refine_outside = false;
};

/// The paper's method, on maps of several resolutions: an approximation of what UniformRayTracer counts. The map must
/// outlive it.
class HierarchicalRayTracer {
 public:
  /// Makes the tree of rays and takes the map at every resolution. Throws std::invalid_argument naming what is wrong.
  HierarchicalRayTracer(const OccupancyMap& map, const RangeSensor& sensor,
                        const HierarchicalRayTracerOptions& options = HierarchicalRayTracerOptions{});

  /// Follows the changes of the map.
  void update();
  /// The rays it casts.
  [[nodiscard]] const RayTree& tree() const { return tree_; }
  /// Counts the rays of a view that end in `object`. A coarser cell is in the box where it overlaps it. Throws
  /// std::invalid_argument if rays cannot be addressed.
  [[nodiscard]] HierarchicalCounts evaluate(const Pose& world_from_sensor, const VoxelBox& object) const;

 private:
  HierarchicalRayTracerOptions options_;
  double max_range_m_;
  RayTree tree_;
  std::vector<RayCaster> casters_;  // by level of the tree
};

}  // namespace vantage

namespace vantage::detail {

// Lines 1 to 10: the children of a ray, or of the root, in the map of their level.
template <class Tree, class Cast, class Rays>
void trace_rays(const Tree& tree, int level, const Rays& rays, const Cast& cast, HierarchicalCounts& counts) {
  for (const std::uint32_t ray : rays) {
    ++counts.casts;
    switch (cast(level, tree.rays(level).directions[ray])) {
      case Occupancy::Occupied:
        if (tree.children(level, ray).empty()) {
          ++counts.occupied;
        } else {
          trace_rays(tree, level + 1, tree.children(level, ray), cast, counts);
        }
        break;
      case Occupancy::Unknown:
        counts.unknown += tree.leaves(level, ray);
        break;
      case Occupancy::Free:
        break;
    }
  }
}

}  // namespace vantage::detail

namespace VANTAGE_EXPORT vantage {

template <class Tree, class Cast>
HierarchicalCounts trace_hierarchically(const Tree& tree, const Cast& cast) {
  std::vector<std::uint32_t> first(tree.rays(0).directions.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    first[i] = static_cast<std::uint32_t>(i);
  }
  HierarchicalCounts counts;
  detail::trace_rays(tree, 0, first, cast, counts);
  return counts;
}

}  // namespace vantage
