// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vantage/planner/nearest_frontier_planner.hpp>
#include <vantage/robot/grid_path.hpp>

namespace vantage {

std::optional<ChosenView> NearestFrontierPlanner::choose(Plan& plan) {
  const std::vector<FrontierTarget>& targets = situation().survey().targets;
  std::vector<VoxelIndex> viewpoints(targets.size());
  std::transform(targets.begin(), targets.end(), viewpoints.begin(),
                 [](const FrontierTarget& target) { return target.viewpoint; });
  std::vector<VoxelIndex> way = GridPaths(situation().reachable()).to_nearest(viewpoints);
  const auto nearest = std::find_if(targets.begin(), targets.end(),
                                    [&](const FrontierTarget& target) { return target.viewpoint == way.back(); });
  return ChosenView{view_of_target(situation(), *nearest, plan.statistics.ray_operations), std::move(way)};
}

}  // namespace vantage
