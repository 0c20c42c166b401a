// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vantage/planner/nearest_frontier_planner.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/robot/grid_path.hpp>

#include "planner/frontier_cycle.hpp"

namespace vantage {

NearestFrontierPlanner::NearestFrontierPlanner(const PlannerSetup& setup, const FrontierSurveyOptions& options)
    : setup_(setup), options_(options), surveyor_(setup.platform, setup.sensor, options) {
  detail::validate(setup);
  detail::validate(options);
  failed_ = FailedViews(options.patience);
}

Plan NearestFrontierPlanner::plan(const OccupancyMap& map, const Pose& current) {
  detail::FrontierCycle cycle(map, current, setup_, surveyor_, failed_);
  if (cycle.over()) {
    return cycle.plan();
  }
  const FrontierSurvey& survey = cycle.survey();
  std::vector<VoxelIndex> viewpoints;
  viewpoints.reserve(survey.targets.size());
  for (const FrontierTarget& target : survey.targets) {
    viewpoints.push_back(target.viewpoint);
  }
  const std::vector<VoxelIndex> way = GridPaths(survey.reachable).to_nearest(viewpoints);
  const auto nearest = std::find_if(survey.targets.begin(), survey.targets.end(),
                                    [&](const FrontierTarget& target) { return target.viewpoint == way.back(); });
  std::uint64_t& operations = cycle.plan().statistics.ray_operations;
  return cycle.go(view_of_target(map, *setup_.platform, setup_.sensor, survey, *nearest, operations), way);
}

}  // namespace vantage
