// SPDX-License-Identifier: MIT
#include <string>
#include <utility>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include "planner/stopwatch.hpp"

namespace vantage {
namespace {

std::optional<std::vector<Pose>> path_of(const Situation& situation, ChosenView& choice) {
  if (!choice.path.empty()) {
    return std::move(choice.path);
  }
  if (situation.reachable().only_turns()) {
    return std::vector<Pose>{situation.current(), choice.view.view.pose};
  }
  return poses_along(situation.map(), situation.platform(), situation.current(), choice.way, choice.view.view.pose);
}

}  // namespace

void ExplorationPlanner::report(const OccupancyMap& /*map*/, const Pose& /*current*/, GoalResult /*result*/) {}

Plan FrontierPlanner::plan(const OccupancyMap& map, const Pose& current) {
  situation_.sync(map, current);
  Plan plan = situation_.open_plan();
  prepare(plan);
  if (std::optional<Plan> end = situation_.end()) {
    end->statistics.void_cells = plan.statistics.void_cells;
    if (end->outcome == Outcome::Move) {
      situation_.remember(*end, {});
    }
    return std::move(*end);
  }
  plan.reason = "the platform cannot follow the way to any view of a frontier";
  while (!situation_.survey().targets.empty()) {
    detail::Stopwatch watch;
    std::optional<ChosenView> choice = choose(plan);
    plan.statistics.choose_ms += watch.lap_ms();
    if (!choice) {
      return plan;
    }
    std::optional<std::vector<Pose>> path = path_of(situation_, *choice);
    plan.statistics.path_ms += watch.lap_ms();
    TargetView& view = choice->view;
    if (!path) {
      if (!situation_.drop(view)) {
        return plan;
      }
      continue;
    }
    plan.outcome = Outcome::Move;
    plan.reason = choice->reason.empty() ? "a view of " + std::to_string(view.unknown.size()) + " unknown cells"
                                         : std::move(choice->reason);
    plan.goal = view.view;
    plan.path = std::move(*path);
    plan.sought = std::move(view.unknown);
    situation_.remember(plan, std::move(view.hoped));
    return plan;
  }
  return plan;
}

void FrontierPlanner::report(const OccupancyMap& /*map*/, const Pose& /*current*/, GoalResult result) {
  situation_.report(result);
}

}  // namespace vantage
