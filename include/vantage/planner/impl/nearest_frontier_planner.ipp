// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/nearest_frontier_planner.hpp>

namespace vantage {

VANTAGE_INLINE std::optional<ChosenView> NearestFrontierPlanner::choose(Plan& plan) {
  return nearest_view(situation(), plan.statistics.ray_operations);
}

}  // namespace vantage
