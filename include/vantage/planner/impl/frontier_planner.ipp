// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/planner/impl/stopwatch.hpp>

namespace vantage {
VANTAGE_INLINE Choice nearest_view(const Situation& situation, const PlanStatistics& so_far) {
  const FrontierSurvey& survey = situation.survey();
  Choice choice{.way = GridPaths(situation.reachable()).to_nearest(survey.viewpoints()), .statistics = so_far};
  const std::optional<FrontierTarget> nearest = survey.target_seen_from(choice.way.back());
  choice.view = view_of_target(situation.surveyed(), *nearest, choice.statistics.ray_operations);
  return choice;
}

VANTAGE_INLINE void ExplorationPlanner::report(const OccupancyMap& /*map*/, const Pose& /*current*/,
                                               GoalResult /*result*/) {}
VANTAGE_INLINE std::string ExplorationPlanner::memory() const { return {}; }
VANTAGE_INLINE void ExplorationPlanner::recall(const OccupancyMap& /*map*/, std::string_view /*memory*/) {}

VANTAGE_INLINE Plan FrontierPlanner::plan(const OccupancyMap& map, const Pose& current) {
  situation_.sync(map, current);
  PlanStatistics spent;
  for (;;) {  // ends, because in each round other places rest, and their number is limited
    const PlanStatistics prepared = prepare(situation_);
    std::vector<VoxelIndex> hoped;
    std::optional<Plan> plan = situation_.end();
    if (!plan) {
      plan = plan_of_choice(hoped, spent);
    }
    const bool is_final =
        plan->outcome == Outcome::Move ? situation_.remember(*plan, std::move(hoped)) : !situation_.look_elsewhere();
    if (is_final) {
      plan->statistics += prepared;
      plan->statistics += spent;
      return *std::move(plan);
    }
  }
}

VANTAGE_INLINE double FrontierPlanner::worth(double utility, double cost_per_m, double way_m) {
  return utility / (1.0 + cost_per_m * way_m);
}

// Chooses views until a path leads to one. What it hopes for is put into `hoped`; adds to `spent`.
VANTAGE_INLINE Plan FrontierPlanner::plan_of_choice(std::vector<VoxelIndex>& hoped, PlanStatistics& spent) {
  Plan plan = situation_.open_plan();
  plan.reason = "the platform cannot follow the path to any view of a frontier";
  while (!situation_.survey().targets.empty()) {
    detail::Stopwatch watch;
    Choice choice = choose(situation_);
    spent += choice.statistics;
    spent.choose_ms += watch.lap_ms();
    plan.candidates = std::move(choice.candidates);
    if (!choice.view) {
      plan.reason = choice.reason.empty() ? "the strategy chose no view" : std::move(choice.reason);
      break;
    }
    TargetView& view = *choice.view;
    if (choice.path.empty()) {
      choice.path = situation_.path_to(view.view.pose, choice.way).value_or(std::vector<Pose>());
    }
    spent.path_ms += watch.lap_ms();
    if (!choice.path.empty()) {
      plan.outcome = Outcome::Move;
      plan.reason = choice.reason.empty() ? "a view of " + std::to_string(view.unknown.size()) + " unknown cells"
                                          : std::move(choice.reason);
      plan.goal = view.view;
      plan.path = std::move(choice.path);
      plan.sought = std::move(view.unknown);
      hoped = std::move(view.hoped);
      break;
    }
    if (!situation_.drop(view)) {
      break;
    }
  }
  return plan;
}

}  // namespace vantage
