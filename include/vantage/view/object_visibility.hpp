// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/following_caster.hpp>
#include <vantage/raytrace/hierarchical_ray_tracer.hpp>
#include <vantage/view/sensing_constraint.hpp>

namespace VANTAGE_EXPORT vantage {

/// How the cells that a view of an object sees are counted.
enum class VisibilityMethod : std::uint8_t {
  Exact,         ///< distinct cells, by evaluate_view
  Uniform,       ///< the same cells, by walking each ray: the method with which Vasquez-Gomez et al. 2013 compare
  Hierarchical,  ///< rays instead of cells, by HierarchicalRayTracer: the method of that paper
};

/// Counts the cells of an object that views see and that the sensor would measure.
class ObjectVisibility {
 public:
  /// For the cells `object` of the map that `looking` follows. Map and `looking` must outlive it and not change. The
  /// hierarchical method has three levels (VI-B: start depth 14 of 16).
  ObjectVisibility(const OccupancyMap& map, const FollowingCaster& looking, const RangeSensor& sensor,
                   const VoxelBox& object, VisibilityMethod method, const SensingOptions& sensing);

  /// What a view (world_from_sensor) sees. The cells are stored in `seen`. May be called from several threads.
  [[nodiscard]] ViewEvaluation evaluate(const Pose& view, CellSet& seen) const;

 private:
  const FollowingCaster& looking_;
  VoxelBox object_;
  VisibilityMethod method_;
  UniformRayTracer uniform_;
  std::optional<HierarchicalRayTracer> hierarchical_;
  SensingConstraint sensing_;  // null if all cells are measured
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/object_visibility.ipp>
#endif
