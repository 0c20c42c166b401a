// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/planner/impl/stopwatch.hpp>

namespace vantage {
VANTAGE_INLINE ChosenView nearest_view(const Situation& situation, std::uint64_t& operations) {
  const FrontierSurvey& survey = situation.survey();
  std::vector<VoxelIndex> way = GridPaths(situation.reachable()).to_nearest(survey.viewpoints());
  const std::optional<FrontierTarget> nearest = survey.target_seen_from(way.back());
  return {.view = view_of_target(situation.surveyed(), *nearest, operations), .way = std::move(way)};
}

VANTAGE_INLINE void ExplorationPlanner::report(const OccupancyMap& /*map*/, const Pose& /*current*/,
                                               GoalResult /*result*/) {}
VANTAGE_INLINE std::string ExplorationPlanner::memory() const { return {}; }
VANTAGE_INLINE void ExplorationPlanner::recall(const OccupancyMap& /*map*/, std::string_view /*memory*/) {}

VANTAGE_INLINE Plan FrontierPlanner::plan(const OccupancyMap& map, const Pose& current) {
  situation_.sync(map, current);
  for (;;) {  // ends, because another place rests each time
    Plan plan = situation_.open_plan();
    prepare(plan);
    std::vector<VoxelIndex> hoped;
    if (std::optional<Plan> end = situation_.end()) {
      end->statistics.void_cells = plan.statistics.void_cells;
      plan = std::move(*end);
    } else {
      hoped = take_a_view(plan);
    }
    if (plan.outcome != Outcome::Move || situation_.remember(plan, std::move(hoped))) {
      return plan;
    }
  }
}

// Makes the plan a Move to a chosen view, if a path leads to one. Returns what the view hopes for.
VANTAGE_INLINE std::vector<VoxelIndex> FrontierPlanner::take_a_view(Plan& plan) {
  plan.reason = "the platform cannot follow the path to any view of a frontier";
  while (!situation_.survey().targets.empty()) {
    detail::Stopwatch watch;
    std::optional<ChosenView> choice = choose(plan);
    plan.statistics.choose_ms += watch.lap_ms();
    if (!choice) {
      return {};
    }
    TargetView& view = choice->view;
    if (choice->path.empty()) {
      choice->path = situation_.path_to(view.view.pose, choice->way).value_or(std::vector<Pose>());
    }
    plan.statistics.path_ms += watch.lap_ms();
    if (choice->path.empty()) {
      if (!situation_.drop(view)) {
        return {};
      }
      continue;
    }
    plan.outcome = Outcome::Move;
    plan.reason = choice->reason.empty() ? "a view of " + std::to_string(view.unknown.size()) + " unknown cells"
                                         : std::move(choice->reason);
    plan.goal = view.view;
    plan.path = std::move(choice->path);
    plan.sought = std::move(view.unknown);
    return std::move(view.hoped);
  }
  return {};
}

}  // namespace vantage
