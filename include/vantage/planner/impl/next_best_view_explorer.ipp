// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/view/view_utility.hpp>
#include <vector>

#include <vantage/geometry/impl/dice.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/view/impl/ranked_views.hpp>

namespace vantage {

VANTAGE_INLINE NextBestViewExplorer::NextBestViewExplorer(const PlannerSetup& setup,
                                                          const NextBestViewExplorerOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::next_best_view_explorer_settings().validate(options);
}

// The utility of a view is the product of eq. 4 and eq. 5.
VANTAGE_INLINE Choice NextBestViewExplorer::choose(const Situation& situation) {
  const OccupancyMap& map = situation.map();
  const FrontierSurvey& survey = situation.survey();
  const ReachableSpace& reachable = situation.reachable();
  const Platform& platform = situation.platform();
  struct Drawn {
    View view;
    double nearness = 0.0;         // eq. 5
    std::uint64_t operations = 0;  // not counted here
  };
  constexpr std::size_t kFinalists = 20;  // views that are evaluated with all rays
  detail::Dice dice(situation.setup().seed, map.revision());
  std::vector<Drawn> drawn;
  const auto near = nearness([&](const Pose& pose) { return platform.distance_m(situation.current(), pose); });
  const auto add = [&](const Pose& pose) { drawn.push_back({{pose}, near(pose)}); };
  if (const std::optional<Pose> goal = situation.goal_ahead()) {
    add(*goal);
  }
  for (std::size_t i = 0; i < options_.hypotheses; ++i) {
    if (i % 2 == 0) {
      const FrontierTarget& target = survey.targets[dice.below(survey.targets.size())];
      const Eigen::Vector3d from = reachable.position_in(target.viewpoint);
      add(platform.facing(from, map.frame().centre_of(target.unknown) - from));
    } else {
      const VoxelIndex cell = reachable.cell(dice.below(reachable.size()));
      add(platform.facing(reachable.position_in(cell), dice.direction()));
    }
  }
  Choice choice{.statistics = {.views_scored = drawn.size()}};
  const VoxelBox everywhere = map.region() ? *map.region() : map.bounds().grown(1);
  const FollowingCaster& looking = situation.looking();
  detail::rank_views(
      looking, situation.setup().threads, drawn, kFinalists, kFinalists, choice.statistics.ray_operations,
      [&](Drawn& candidate, const ViewRays& rays) {
        const ViewEvaluation seen = evaluate_view(looking.caster(), candidate.view.pose, rays, everywhere);
        candidate.view.utility = static_cast<double>(seen.unknown) * candidate.nearness;
      },
      [](const Drawn& a, const Drawn& b) { return a.view.utility > b.view.utility; });
  // The best view that sees a target; cells that are given up are no targets.
  TargetView best;
  for (const Drawn& candidate : drawn) {
    if (candidate.view.utility > 0.0) {
      choice.candidates.push_back(candidate.view);
    }
    if (best.unknown.empty()) {
      best = targets_seen_from(situation.surveyed(), candidate.view.pose, choice.statistics.ray_operations);
      best.view.utility = candidate.view.utility;
    }
  }
  if (best.unknown.empty()) {
    best = view_of_target(situation.surveyed(), survey.targets.front(), choice.statistics.ray_operations);
  }
  choice.view = std::move(best);
  return choice;
}

}  // namespace vantage
