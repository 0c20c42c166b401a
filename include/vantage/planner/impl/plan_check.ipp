// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <vantage/planner/plan_check.hpp>

namespace vantage {
namespace detail {

inline double distance_to_segment_m(const Eigen::Vector3d& point, const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to) {
  const Eigen::Vector3d step = to - from;
  const double length2 = step.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((point - from).dot(step) / length2, 0.0, 1.0) : 0.0;
  return (from + share * step - point).norm();
}

}  // namespace detail

VANTAGE_INLINE PlanCheck check(const Plan& plan, const OccupancyMap& map, const Platform& platform,
                               const Pose& current, double off_path_m) {
  if (plan.outcome != Outcome::Move || plan.path.empty()) {
    return PlanCheck::Good;
  }
  if (!plan.sought.empty() && std::none_of(plan.sought.begin(), plan.sought.end(), [&](const VoxelIndex& cell) {
        return map.at(cell) == Occupancy::Unknown || map.contested(cell);
      })) {
    return PlanCheck::NothingLeft;
  }
  // Among equally near segments the last one: where a path crosses itself, the later part is taken as reached.
  double nearest_m = (plan.path.front().translation() - current.translation()).norm();
  std::size_t next = 0;
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    const double distance_m = detail::distance_to_segment_m(current.translation(), plan.path[i - 1].translation(),
                                                            plan.path[i].translation());
    if (distance_m <= nearest_m) {
      nearest_m = distance_m;
      next = i;
    }
  }
  if (nearest_m > off_path_m) {
    return PlanCheck::OffPath;
  }
  for (Pose from = current; next < plan.path.size(); from = plan.path[next++]) {
    if (!platform.admits_motion(map, from, plan.path[next])) {
      return PlanCheck::WayClosed;
    }
  }
  return PlanCheck::Good;
}

}  // namespace vantage
