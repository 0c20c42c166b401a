// SPDX-License-Identifier: MIT
#include "planner/frontier_cycle.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/robot/grid_path.hpp>

#include "map/option_rule.hpp"

namespace vantage::detail {
namespace {

FrontierSurvey checked_survey(const OccupancyMap& map, const Pose& current, FrontierSurveyor& surveyor,
                              FailedViews& failed, std::optional<std::vector<VoxelIndex>> frontier) {
  validate(map, current);
  failed.review(map, current);
  return surveyor.survey(map, current, failed, frontier ? std::move(*frontier) : frontier_cells(map));
}

}  // namespace

FrontierCycle::FrontierCycle(const OccupancyMap& map, const Pose& current, const PlannerSetup& setup,
                             FrontierSurveyor& surveyor, FailedViews& failed,
                             std::optional<std::vector<VoxelIndex>> frontier)
    : map_(map),
      current_(current),
      setup_(setup),
      failed_(failed),
      survey_(checked_survey(map, current, surveyor, failed, std::move(frontier))) {
  plan_.leftover = survey_.leftover;
  plan_.statistics.frontier_cells = survey_.frontier_cells;
  plan_.statistics.observable_cells = survey_.targets.size();
  plan_.statistics.reachable_cells = survey_.reachable.size();
  plan_.statistics.ray_operations = survey_.ray_operations;
  plan_.statistics.survey_ms = stopwatch_.lap_ms();
  const Leftover& left = survey_.leftover;
  if (survey_.frontier_cells > 0 && !survey_.reachable.start()) {
    over_ = true;
    plan_.outcome = Outcome::Blocked;
    plan_.reason = "the platform does not admit the place where it is, and there is no free place beside it";
  } else if (survey_.targets.empty()) {
    over_ = true;
    plan_.outcome = Outcome::Explored;
    plan_.reason = survey_.frontier_cells == 0
                       ? "no frontier is left"
                       : "no observable frontier is left; given up: " + std::to_string(left.unreachable) +
                             " unreachable, " + std::to_string(left.unobservable) + " unobservable, " +
                             std::to_string(left.too_small) + " too small" +
                             (survey_.exhausted ? "" : " (not every line of sight was tried)");
  }
}

Plan FrontierCycle::go(TargetView chosen, std::span<const VoxelIndex> way) {
  plan_.statistics.choose_ms += stopwatch_.lap_ms();
  auto path = poses_along(map_, *setup_.platform, current_, way, chosen.view.pose);
  if (!path) {
    return blocked("the platform cannot follow the way to the chosen view");
  }
  return go(std::move(chosen), std::move(*path));
}

Plan FrontierCycle::go(TargetView chosen, std::vector<Pose> path) {
  plan_.statistics.path_ms += stopwatch_.lap_ms();
  plan_.outcome = Outcome::Move;
  plan_.goal = chosen.view;
  plan_.path = std::move(path);
  plan_.reason = "a view of " + std::to_string(chosen.unknown.size()) + " frontier cells";
  plan_.sought = std::move(chosen.unknown);
  failed_.expect(map_, plan_.goal.pose, plan_.sought, std::move(chosen.hoped));
  return std::move(plan_);
}

Plan FrontierCycle::blocked(std::string reason) {
  plan_.outcome = Outcome::Blocked;
  plan_.reason = std::move(reason);
  return std::move(plan_);
}

void validate(const OccupancyMap& map, const Pose& current) {
  if (!is_rigid(current)) {
    throw std::invalid_argument("plan(): the current pose is not a rigid transform");
  }
  if (!map.frame().addressable(current.translation()) || !map.in_region(map.frame().cell_of(current.translation()))) {
    throw std::invalid_argument("plan(): the current pose is outside the map's region");
  }
}

void validate(const PlannerSetup& setup) {
  if (setup.platform == nullptr) {
    throw std::invalid_argument("PlannerSetup::platform is null, must be a platform");
  }
  require_option(setup.threads >= 1, "PlannerSetup::threads", setup.threads, ">= 1");
  setup.sensor.validate();
}

void validate(const FrontierSurveyOptions& options) {
  require_option(options.min_cluster_cells >= 1, "FrontierSurveyOptions::min_cluster_cells",
                 options.min_cluster_cells, ">= 1");
  require_option(options.min_contested_cluster_cells >= 1, "FrontierSurveyOptions::min_contested_cluster_cells",
                 options.min_contested_cluster_cells, ">= 1");
  require_option(options.patience >= 1, "FrontierSurveyOptions::patience", options.patience, ">= 1");
  require_option(options.sight_directions >= 6, "FrontierSurveyOptions::sight_directions", options.sight_directions,
                 ">= 6");
}

}  // namespace vantage::detail
