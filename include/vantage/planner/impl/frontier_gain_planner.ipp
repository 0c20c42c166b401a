// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vantage/planner/frontier_gain_planner.hpp>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/planner/impl/planner_tables.hpp>

namespace vantage {

VANTAGE_INLINE FrontierGainPlanner::FrontierGainPlanner(const PlannerSetup& setup, const FrontierGainOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::frontier_gain_settings().validate(options);
}

VANTAGE_INLINE Choice FrontierGainPlanner::choose(const Situation& situation) {
  const FrontierSurvey& survey = situation.survey();
  const ReachableSpace& reachable = situation.reachable();
  const Platform& platform = situation.platform();
  detail::Dice dice(situation.setup().seed, situation.map().revision());
  Choice choice;
  std::optional<TargetView>& best = choice.view;
  double best_value = 0.0;
  const auto consider = [&](TargetView candidate) {
    ++choice.statistics.views_scored;
    const double way_m = platform.distance_m(situation.current(), candidate.view.pose);
    if (candidate.view.utility > 0.0) {
      choice.candidates.push_back(candidate.view);
    }
    if (const double value = worth(candidate.view.utility, options_.cost_per_m, way_m); value > best_value) {
      best_value = value;
      best = std::move(candidate);
    }
  };
  if (const std::optional<Pose> goal = situation.goal_ahead()) {
    consider(targets_seen_from(situation.surveyed(), *goal, choice.statistics.ray_operations));
  }
  for (std::size_t i = 0; i < options_.hypotheses; ++i) {
    const VoxelIndex cell = reachable.cell(dice.below(reachable.size()));
    const Pose pose = platform.facing(reachable.position_in(cell), dice.direction());
    consider(targets_seen_from(situation.surveyed(), pose, choice.statistics.ray_operations));
  }
  for (std::size_t i = 0; i < options_.hypotheses && !best; ++i) {
    const FrontierTarget& target = survey.targets[dice.below(survey.targets.size())];
    consider(view_of_target(situation.surveyed(), target, choice.statistics.ray_operations));
  }
  if (!best) {  // no random pose sees a target, and the aimed ones are beyond the resolving range
    best = view_of_target(situation.surveyed(), survey.targets.front(), choice.statistics.ray_operations);
  }
  return choice;
}

}  // namespace vantage
