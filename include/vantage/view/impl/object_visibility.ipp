// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/view/object_visibility.hpp>

namespace vantage {

VANTAGE_INLINE ObjectVisibility::ObjectVisibility(const OccupancyMap& map, const FollowingCaster& looking,
                                                  const RangeSensor& sensor, const VoxelBox& object,
                                                  VisibilityMethod method, const SensingOptions& sensing)
    : looking_(looking), object_(object), method_(method), uniform_(map) {
  if (method == VisibilityMethod::Hierarchical) {
    hierarchical_.emplace(map, sensor, HierarchicalRayTracerOptions{.levels = 3});
  }
  if (sensing.restricts()) {
    sensing_ = measurable(map, object, sensing);
  }
}

VANTAGE_INLINE ViewEvaluation ObjectVisibility::evaluate(const Pose& view, CellSet& seen) const {
  ViewEvaluation evaluation = method_ == VisibilityMethod::Uniform
                                  ? uniform_.evaluate(view, looking_.rays(), object_, &seen)
                                  : evaluate_view(looking_.caster(), view, looking_.rays(), object_, &seen);
  if (sensing_) {
    sensing_(view, seen);
    evaluation = {looking_.caster().count(seen, Occupancy::Unknown),
                  looking_.caster().count(seen, Occupancy::Occupied)};
  }
  if (hierarchical_) {
    const HierarchicalCounts counts = hierarchical_->evaluate(view, object_);
    evaluation = {counts.unknown, counts.occupied};
  }
  return evaluation;
}

}  // namespace vantage
