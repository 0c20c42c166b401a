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

/// What a view sees of an object box: distinct cells (Vasquez-Gomez et al. 2013, IV-A).
struct ViewEvaluation {
  std::size_t unknown = 0;   ///< unknown cells seen, `un_o(v)`: what the view may learn
  std::size_t occupied = 0;  ///< occupied cells seen, `oc_o(v)`: its overlap with what is known of the surface

  /// The same counts.
  friend bool operator==(const ViewEvaluation&, const ViewEvaluation&) = default;
};

/// Counts the distinct cells of `object` that a view sees in the map of `caster`: exactly those that uniform ray
/// tracing at full resolution counts (UniformRayTracer). `seen`, if given, gets which cells they are. Errors as
/// RayCaster::cast.
[[nodiscard]] ViewEvaluation evaluate_view(const RayCaster& caster, const Pose& world_from_sensor,
                                           const ViewRays& rays, const VoxelBox& object, CellSet* seen = nullptr);

/// The same for many poses of one sensor, by this many threads; the result does not depend on their number. Throws
/// std::invalid_argument unless `threads` is > 0; other errors as RayCaster::cast.
[[nodiscard]] std::vector<ViewEvaluation> evaluate_views(const RayCaster& caster, std::span<const Pose> views,
                                                         const ViewRays& rays, const VoxelBox& object,
                                                         std::size_t threads = 1);

/// Uniform ray tracing, the definition of what a view sees: every ray of the sensor, cell by cell through the map at
/// its finest resolution. Slow; it is what `evaluate_view` is tested against, and the paper's method of comparison.
/// The map must outlive it.
class UniformRayTracer {
 public:
  /// For views in this map.
  explicit UniformRayTracer(const OccupancyMap& map) : map_(&map) {}

  /// As vantage::evaluate_view.
  [[nodiscard]] ViewEvaluation evaluate(const Pose& world_from_sensor, const ViewRays& rays, const VoxelBox& object,
                                        CellSet* seen = nullptr) const;

 private:
  const OccupancyMap* map_;
};

}  // namespace vantage
