// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/robot/grid_path.hpp>

#include "map/option_rule.hpp"
#include "planner/frontier_cycle.hpp"

namespace vantage {
namespace {

// Draws of our own from the engine's bits: the standard distributions differ from library to library.
class Dice {
 public:
  Dice(std::uint64_t seed, OccupancyMap::Revision revision) : engine_(seed * 0x9E3779B97F4A7C15ULL + revision) {}

  double share() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(share() * static_cast<double>(count)); }
  Eigen::Vector3d direction() {
    const double z = 2.0 * share() - 1.0;
    const double angle = 2.0 * std::numbers::pi * share();
    const double level = std::sqrt(1.0 - z * z);
    return {level * std::cos(angle), level * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

void validate(const FrontierGainOptions& options) {
  detail::require_option(options.hypotheses >= 1, "FrontierGainOptions::hypotheses", options.hypotheses, ">= 1");
  detail::require_option(options.aimed_share >= 0.0 && options.aimed_share <= 1.0, "FrontierGainOptions::aimed_share",
                         options.aimed_share, "in [0, 1]");
  detail::require_option(options.cost_per_m >= 0.0, "FrontierGainOptions::cost_per_m", options.cost_per_m, ">= 0");
  detail::validate(options.survey);
}

}  // namespace

FrontierGainPlanner::FrontierGainPlanner(const PlannerSetup& setup, const FrontierGainOptions& options)
    : setup_(setup), options_(options) {
  detail::validate(setup);
  validate(options);
  failed_ = FailedViews(options.survey.patience);
}

Plan FrontierGainPlanner::plan(const OccupancyMap& map, const Pose& current) {
  detail::FrontierCycle cycle(map, current, setup_, options_.survey, failed_);
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
