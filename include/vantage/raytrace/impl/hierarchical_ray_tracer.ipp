// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/raytrace/hierarchical_ray_tracer.hpp>

namespace vantage {
namespace detail {

// The coarse cells, with an edge of 2^level finest cells, that overlap a box.
inline VoxelBox coarser(const VoxelBox& box, int level) {
  const std::int32_t more = (1 << level) - 1;
  return {{box.lo.x >> level, box.lo.y >> level, box.lo.z >> level},
          {(box.hi.x + more) >> level, (box.hi.y + more) >> level, (box.hi.z + more) >> level}};
}

}  // namespace detail

VANTAGE_INLINE HierarchicalRayTracer::HierarchicalRayTracer(const OccupancyMap& map, const RangeSensor& sensor,
                                                            const HierarchicalRayTracerOptions& options)
    : options_(options), max_range_m_(sensor.max_range_m), tree_(sensor, map.resolution_m(), options.levels) {
  for (int level = options.levels - 1; level >= 0; --level) {
    casters_.emplace_back(map, RayCasterOptions{level, options.policy});
  }
}

VANTAGE_INLINE void HierarchicalRayTracer::update() {
  for (RayCaster& caster : casters_) {
    caster.update();
  }
}

VANTAGE_INLINE HierarchicalCounts HierarchicalRayTracer::evaluate(const Pose& world_from_sensor,
                                                                  const VoxelBox& object) const {
  const Eigen::Vector3d& origin = world_from_sensor.translation();
  std::vector<VoxelBox> boxes;
  for (const RayCaster& caster : casters_) {
    boxes.push_back(detail::coarser(object, caster.options().level));
  }
  return trace_hierarchically(tree_, [&](int level, const Eigen::Vector3f& direction) {
    const auto l = static_cast<std::size_t>(level);
    const Eigen::Vector3d along = world_from_sensor.linear() * direction.cast<double>();
    const RayEnd end = casters_[l].cast(origin, origin + max_range_m_ * along);
    // Free: neither counted nor refined. An occupied cell outside the box is passed on only to be refined, and at the
    // finest level there is nothing to refine.
    const bool refined = options_.refine_outside && end.occupancy == Occupancy::Occupied && l + 1 < casters_.size();
    return refined || boxes[l].contains(end.cell) ? end.occupancy : Occupancy::Free;
  });
}

}  // namespace vantage
