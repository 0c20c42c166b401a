// SPDX-License-Identifier: MIT
#include <optional>
#include <utility>
#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/robot/grid_path.hpp>

#include "geometry/dice.hpp"
#include "map/option_rule.hpp"
#include "planner/frontier_cycle.hpp"

namespace vantage {
namespace {

void validate(const FrontierGainOptions& options) {
  detail::require_option(options.hypotheses >= 1, "FrontierGainOptions::hypotheses", options.hypotheses, ">= 1");
  detail::require_option(options.aimed_share >= 0.0 && options.aimed_share <= 1.0, "FrontierGainOptions::aimed_share",
                         options.aimed_share, "in [0, 1]");
  detail::require_option(options.cost_per_m >= 0.0, "FrontierGainOptions::cost_per_m", options.cost_per_m, ">= 0");
  detail::validate(options.survey);
}

}  // namespace

FrontierGainPlanner::FrontierGainPlanner(const PlannerSetup& setup, const FrontierGainOptions& options)
    : setup_(setup), options_(options), surveyor_(setup.platform, setup.sensor, options.survey) {
  detail::validate(setup);
  validate(options);
  failed_ = FailedViews(options.survey.patience);
}

Plan FrontierGainPlanner::plan(const OccupancyMap& map, const Pose& current) {
  detail::FrontierCycle cycle(map, current, setup_, surveyor_, failed_);
  if (cycle.over()) {
    return cycle.plan();
  }
  const FrontierSurvey& survey = cycle.survey();
  const Platform& platform = *setup_.platform;
  PlanStatistics& statistics = cycle.plan().statistics;
  Dice dice(setup_.seed, map.revision());
  std::optional<TargetView> best;
  double best_value = 0.0;
  const auto consider = [&](TargetView candidate) {
    ++statistics.views_scored;
    const double value =
        candidate.view.utility - options_.cost_per_m * platform.distance_m(current, candidate.view.pose);
    if (candidate.view.utility > 0.0) {
      cycle.plan().candidates.push_back(candidate.view);
    }
    if (candidate.view.utility > 0.0 && (!best || value > best_value)) {
      best_value = value;
      best = std::move(candidate);
    }
  };
  const auto aimed = [&] {
    const FrontierTarget& target = survey.targets[dice.below(survey.targets.size())];
    consider(view_of_target(map, platform, setup_.sensor, survey, target, statistics.ray_operations));
  };
  const auto anywhere = [&] {
    const VoxelIndex& cell = survey.reachable.cells()[dice.below(survey.reachable.size())];
    const Pose pose = platform.facing(map.frame().centre_of(cell), dice.direction());
    consider(targets_seen_from(map, setup_.sensor, survey, pose, statistics.ray_operations));
  };

  const auto aimed_count = static_cast<std::size_t>(options_.aimed_share * static_cast<double>(options_.hypotheses));
  for (std::size_t i = 0; i < options_.hypotheses; ++i) {
    i < aimed_count ? aimed() : anywhere();
  }
  for (std::size_t i = 0; i < options_.hypotheses && !best; ++i) {
    aimed();
  }
  if (!best) {
    return cycle.blocked("no hypothesised pose sees a frontier");
  }
  const std::vector<VoxelIndex> way =
      GridPaths(survey.reachable).to(map.frame().cell_of(best->view.pose.translation()));
  return cycle.go(std::move(*best), way);
}

}  // namespace vantage
