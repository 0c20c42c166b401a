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

/// Result of hierarchical ray tracing for a view. It counts rays, not distinct cells, so the numbers exceed those of
/// ViewEvaluation.
struct HierarchicalCounts {
  std::size_t occupied = 0;  ///< finest rays that end in an occupied cell
  std::size_t unknown = 0;   ///< finest rays that descend from a ray, of any level, that ends in an unknown cell
  std::size_t casts = 0;     ///< rays that were cast

  /// Whether all counts are equal.
  friend bool operator==(const HierarchicalCounts&, const HierarchicalCounts&) = default;
};

/// Hierarchical ray tracing, Algorithm 2 of Vasquez-Gomez et al. 2013. It first casts the coarsest rays of the tree.
/// If a ray ends in an occupied cell, its children are cast in the next finer map, down to the finest level. If a ray
/// ends in an unknown cell, its leaves are counted and it is not refined.
///
/// `cast(level, direction)` must cast a ray of a tree level, given by its direction in the sensor frame, in the map
/// of that level. It returns the state of the end cell if that counts; otherwise it returns Free, which is neither
/// counted nor refined. `tree` is a RayTree, or any type with its `rays`, `children` and `leaves`.
template <class Tree, class Cast>
[[nodiscard]] HierarchicalCounts trace_hierarchically(const Tree& tree, const Cast& cast);

/// Number of resolutions of HierarchicalRayTracer, and its rules for coarse cells.
struct HierarchicalRayTracerOptions {
  /// Number of resolutions from the coarsest to the finest, in [1, 16]. The paper's start depth 14 in an octree of
  /// depth 16 is 3 levels. One level is uniform ray tracing.
  int levels = 4;
  /// How the state of a coarse cell is computed from the finest cells inside it (V-A.1).
  CoarseningPolicy policy = CoarseningPolicy::Max;
  /// Whether rays that end in a coarse occupied cell outside the object box are refined too, as in the paper's
  /// algorithm. Such cells never count. But without refinement, a coarse cell that is mostly free hides what lies
  /// behind it.
  bool refine_outside = false;
};

/// Hierarchical ray tracing on maps of several resolutions: an approximation of UniformRayTracer. The map must
/// outlive the tracer. (Vasquez-Gomez et al. 2013, V.)
class HierarchicalRayTracer {
 public:
  /// Builds the ray tree and the map at every resolution. Throws std::invalid_argument, which names the invalid
  /// option.
  HierarchicalRayTracer(const OccupancyMap& map, const RangeSensor& sensor,
                        const HierarchicalRayTracerOptions& options = HierarchicalRayTracerOptions{});

  /// Applies the changes of the map since the last call.
  void update();
  /// The rays of all resolutions; level 0 is the coarsest.
  [[nodiscard]] const RayTree& tree() const { return tree_; }
  /// Counts the rays of a view that end in `object`. A coarse cell counts if it overlaps the box. Throws
  /// std::invalid_argument if a ray is not addressable.
  [[nodiscard]] HierarchicalCounts evaluate(const Pose& world_from_sensor, const VoxelBox& object) const;

 private:
  HierarchicalRayTracerOptions options_;
  double max_range_m_;
  RayTree tree_;
  std::vector<RayCaster> casters_;  // one per tree level, coarsest first
};

}  // namespace vantage

namespace vantage::detail {

// Algorithm 2, lines 1 to 10: casts sibling rays in the map of their level.
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

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/hierarchical_ray_tracer.ipp>
#endif
