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

VANTAGE_INLINE std::optional<ChosenView> FrontierGainPlanner::choose(Plan& plan) {
  const FrontierSurvey& survey = situation().survey();
  const ReachableSpace& reachable = situation().reachable();
  const Platform& platform = situation().platform();
  detail::Dice dice(situation().setup().seed, situation().map().revision());
  std::optional<TargetView> best;
  double best_value = 0.0;
  const auto consider = [&](TargetView candidate) {
    ++plan.statistics.views_scored;
    const double value = candidate.view.utility -
                         options_.cost_per_m * platform.distance_m(situation().current(), candidate.view.pose);
    if (candidate.view.utility > 0.0) {
      plan.candidates.push_back(candidate.view);
    }
    if (candidate.view.utility > 0.0 && (!best || value > best_value)) {
      best_value = value;
      best = std::move(candidate);
    }
  };
  if (const std::optional<Pose> goal = situation().goal_ahead()) {
    consider(targets_seen_from(situation().surveyed(), *goal, plan.statistics.ray_operations));
  }
  const auto aimed = [&] {
    const FrontierTarget& target = survey.targets[dice.below(survey.targets.size())];
    consider(view_of_target(situation().surveyed(), target, plan.statistics.ray_operations));
  };
  const auto anywhere = [&] {
    const VoxelIndex cell = reachable.cell(dice.below(reachable.size()));
    const Pose pose = platform.facing(reachable.position_in(cell), dice.direction());
    consider(targets_seen_from(situation().surveyed(), pose, plan.statistics.ray_operations));
  };

  const auto aimed_count = static_cast<std::size_t>(options_.aimed_share * static_cast<double>(options_.hypotheses));
  for (std::size_t i = 0; i < options_.hypotheses; ++i) {
    i < aimed_count ? aimed() : anywhere();
  }
  for (std::size_t i = 0; i < options_.hypotheses && !best; ++i) {
    aimed();
  }
  if (!best) {  // no random pose sees a target, and the aimed ones are beyond the resolving range
    best = view_of_target(situation().surveyed(), survey.targets.front(), plan.statistics.ray_operations);
  }
  return ChosenView{std::move(*best)};
}

}  // namespace vantage
