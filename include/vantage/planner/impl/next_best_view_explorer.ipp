// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/view/view_utility.hpp>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

VANTAGE_INLINE NextBestViewExplorer::NextBestViewExplorer(const PlannerSetup& setup,
                                                          const NextBestViewExplorerOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::require_option(options.hypotheses >= 1, "NextBestViewExplorerOptions::hypotheses", options.hypotheses,
                         ">= 1");
}

VANTAGE_INLINE std::optional<ChosenView> NextBestViewExplorer::choose(Plan& plan) {
  const OccupancyMap& map = situation().map();
  const FrontierSurvey& survey = situation().survey();
  const ReachableSpace& reachable = situation().reachable();
  const Platform& platform = situation().platform();
  Dice dice(situation().setup().seed, map.revision());
  std::vector<Pose> drawn;
  for (std::size_t i = 0; i < options_.hypotheses; ++i) {
    if (i % 2 == 0) {
      const FrontierTarget& target = survey.targets[dice.below(survey.targets.size())];
      const Eigen::Vector3d from = reachable.position_in(target.viewpoint);
      drawn.push_back(platform.facing(from, map.frame().centre_of(target.unknown) - from));
    } else {
      const VoxelIndex cell = reachable.cell(dice.below(reachable.size()));
      drawn.push_back(platform.facing(reachable.position_in(cell), dice.direction()));
    }
  }
  UtilityFactors factors;
  factors.surface = unknown_cells();
  factors.distance = nearness([&](const Pose& pose) { return platform.distance_m(situation().current(), pose); });
  const std::vector<ScoredView> scored =
      score_views(situation().looking().caster(), drawn, situation().looking().rays(),
                  map.region() ? *map.region() : map.bounds().grown(1), factors,
                  static_cast<std::size_t>(situation().setup().threads));
  plan.statistics.views_scored += scored.size();
  std::vector<std::size_t> order(scored.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scored[a].utility > scored[b].utility; });
  plan.candidates.clear();
  // The best view that sees a target; cells that are given up are no targets.
  TargetView best;
  for (const std::size_t i : order) {
    if (scored[i].utility > 0.0) {
      plan.candidates.push_back({scored[i].pose, scored[i].utility});
    }
    if (best.unknown.empty()) {
      best = targets_seen_from(situation().surveyed(), scored[i].pose, plan.statistics.ray_operations);
      best.view.utility = scored[i].utility;
    }
  }
  if (best.unknown.empty()) {
    best = view_of_target(situation().surveyed(), survey.targets.front(), plan.statistics.ray_operations);
  }
  return ChosenView{std::move(best)};
}

}  // namespace vantage
