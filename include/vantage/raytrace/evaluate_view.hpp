// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a view sees of an object box, in distinct cells (Vasquez-Gomez et al. 2013, IV-A).
struct ViewEvaluation {
  std::size_t unknown = 0;   ///< visible unknown cells, `un_o(v)`: what the view may make known
  std::size_t occupied = 0;  ///< visible occupied cells, `oc_o(v)`: the overlap with the known surface

  /// Whether all counts are equal.
  friend bool operator==(const ViewEvaluation&, const ViewEvaluation&) = default;
};

/// Counts the distinct cells of `object` that a view sees in the map of `caster`. The result equals that of
/// UniformRayTracer at full resolution. If `seen` is not null, it receives the visible cells. Errors as
/// RayCaster::visible_cells.
[[nodiscard]] ViewEvaluation evaluate_view(const RayCaster& caster, const Pose& world_from_sensor,
                                           const ViewRays& rays, const VoxelBox& object, CellSet* seen = nullptr);

/// Evaluates many poses of one sensor with `threads` threads. The result does not depend on the number of threads.
/// Throws std::invalid_argument if `threads` is 0; other errors as evaluate_view.
[[nodiscard]] std::vector<ViewEvaluation> evaluate_views(const RayCaster& caster, std::span<const Pose> views,
                                                         const ViewRays& rays, const VoxelBox& object,
                                                         std::size_t threads = 1);

/// Uniform ray tracing: follows every ray of the sensor, cell by cell, through the map at its finest resolution. It
/// is the reference implementation of `evaluate_view`, and the baseline of the paper. It is slow. The map must
/// outlive it.
class UniformRayTracer {
 public:
  /// Evaluates views in `map`.
  explicit UniformRayTracer(const OccupancyMap& map) : map_(&map) {}

  /// Same as vantage::evaluate_view.
  [[nodiscard]] ViewEvaluation evaluate(const Pose& world_from_sensor, const ViewRays& rays, const VoxelBox& object,
                                        CellSet* seen = nullptr) const;

 private:
  const OccupancyMap* map_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/evaluate_view.ipp>
#endif
