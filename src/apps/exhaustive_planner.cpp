// SPDX-License-Identifier: MIT
#include "apps/exhaustive_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>

#include <vantage/raytrace/impl/shared_work.hpp>
#include "apps/exhaustive_search.hpp"

namespace vantage::apps {
namespace {

// As the defaults of frontier-void.
constexpr UnknownSightOptions kLikeFrontierVoid{.opaque_share = 0.05, .opaque_beside_surface = 0.5};
constexpr double kFewRays = 4.0;         // ray spacing of the first count, as a multiple of the full one
constexpr std::size_t kFinalists = 100;  // views that are counted with all rays

}  // namespace

ExhaustivePlanner::ExhaustivePlanner(std::shared_ptr<const Arm> arm, const PlannerSetup& setup, double least_view_m3)
    : arm_(std::move(arm)),
      setup_(setup),
      least_view_m3_(least_view_m3),
      tried_(setup.sensor, {setup.goal_tolerance_m, setup.goal_tolerance_rad}) {
  setup.validate();
}

void ExhaustivePlanner::weigh(std::vector<Weighed>& views, const OccupancyMap& map, const UnknownSight& sight,
                              const RayCaster& caster, const ViewRays& rays) const {
  detail::share_work(views.size(), static_cast<std::size_t>(setup_.threads), [&](std::size_t i) {
    views[i].void_cells = 0.0;
    views[i].hoped.clear();
    const VoxelIndex place = map.frame().cell_of(views[i].pose.translation());
    std::uint64_t operations = 0;
    for (const SightedCell& seen : sight.look(caster, views[i].pose, rays, operations)) {
      if (!tried_.hoped_in_vain(seen.cell, place)) {
        views[i].void_cells += seen.chance;
        views[i].hoped.push_back(seen.cell);
      }
    }
  });
  std::stable_sort(views.begin(), views.end(),
                   [](const Weighed& a, const Weighed& b) { return a.void_cells > b.void_cells; });
  views.resize(std::min(views.size(), kFinalists));
}

Plan ExhaustivePlanner::plan(const OccupancyMap& map, const Pose& current) {
  tried_.review(map, current);
  const std::vector<VoxelIndex> voids = void_cells(map);
  Plan plan;
  plan.statistics.void_cells = voids.size();
  if (voids.empty()) {
    plan.outcome = Outcome::Explored;
    plan.reason = "no void cell is left";
    return plan;
  }
  UnknownSightOptions options = kLikeFrontierVoid;
  options.reports_no_return = setup_.sensor.reports_no_return;
  const UnknownSight sight(map, BrickSet(voids), options);
  const RayCaster caster(map);
  std::vector<Weighed> views;
  for (const Pose& pose : exhaustive_poses(*arm_, map)) {
    views.push_back({pose});
  }
  plan.statistics.views_scored = views.size();
  weigh(views, map, sight, caster, ViewRays(setup_.sensor.rays_for(kFewRays * map.resolution_m())));
  weigh(views, map, sight, caster, ViewRays(setup_.sensor.rays_for(map.resolution_m())));
  const double least_cells = std::max(1.0, least_view_m3_ / std::pow(map.resolution_m(), 3));
  const auto worth_it = [&](const Weighed& view) { return std::round(view.void_cells) >= std::ceil(least_cells); };
  if (views.empty() || !worth_it(views.front())) {
    plan.outcome = Outcome::Explored;
    plan.reason = "no pose of the arm is expected to see " + std::to_string(std::llround(std::ceil(least_cells))) +
                  " void cells";
    return plan;
  }
  for (Weighed& view : views) {
    if (!worth_it(view)) {
      break;
    }
    auto path = arm_->path(map, current, view.pose);
    if (path && tried_.expect(map, *path, {}, view.hoped)) {
      plan.outcome = Outcome::Move;
      plan.goal = {view.pose, std::round(view.void_cells)};
      plan.path = std::move(*path);
      plan.reason = "the best of " + std::to_string(plan.statistics.views_scored) + " poses";
      return plan;
    }
  }
  plan.reason = "there is no path to the best poses of the arm";
  return plan;
}

}  // namespace vantage::apps
