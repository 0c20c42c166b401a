// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vantage/planner/object_planner.hpp>
#include <vantage/robot/way_around.hpp>

#include <vantage/planner/impl/blocked_reasons.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/planner/impl/stopwatch.hpp>
#include <vantage/raytrace/impl/shared_work.hpp>

namespace vantage {

VANTAGE_INLINE ObjectPlanner::ObjectPlanner(const PlannerSetup& setup, const ObjectPlannerOptions& options)
    : setup_(setup),
      options_(options),
      tried_(setup.sensor,
             {.goal_tolerance_m = setup.goal_tolerance_m, .goal_tolerance_rad = setup.goal_tolerance_rad}) {
  setup.validate();
  detail::object_planner_settings().validate(options);
}

// Assumes that a new revision is a scan at `current`.
VANTAGE_INLINE void ObjectPlanner::follow(const OccupancyMap& map, const Pose& current) {
  const bool known = map_.is_in_place(map);
  if (!known) {
    map_ = KnownMap();
    shells_ = with_radii(options_.candidates, setup_.sensor, *setup_.platform, map.resolution_m());
    surface_.emplace(map, map.frame().cells_centred_in(shells_.object));
    rays_.emplace(setup_.sensor.rays_for(map.resolution_m()));
    map_ = KnownMap(map);
  }
  if (!known || map.revision() != revision_) {
    surface_->look(map, current, *rays_);
    revision_ = map.revision();
  }
}

// Estimated path length, metres: straight, or along an arc if the object is in between.
VANTAGE_INLINE double ObjectPlanner::way_m(const Pose& from, const Pose& to) const {
  const Eigen::Vector3d a = from.translation() - shells_.object.centre();
  const Eigen::Vector3d b = to.translation() - shells_.object.centre();
  const Eigen::Vector3d half = 0.5 * shells_.object.extent();
  bool through = false;
  for (int i = 1; i < 16 && !through; ++i) {
    through = ((a + (b - a) * (i / 16.0)).cwiseAbs().array() < half.array()).all();
  }
  if (!through) {
    return setup_.platform->distance_m(from, to);
  }
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 0.5 * (a.norm() + b.norm()) + std::abs(a.norm() - b.norm());
}

VANTAGE_INLINE std::vector<ObjectPlanner::Candidate> ObjectPlanner::candidates(const OccupancyMap& map,
                                                                               const Pose& current) const {
  std::vector<Pose> aimed;
  if (shells_.aimed_candidates > 0) {
    aimed = aimed_views(surface_->caster(), surface_->left(), shells_.aimed(), setup_.seed);
  }
  std::vector<Candidate> admitted;
  for (const Pose& pose : views_of_object(shells_, map, *setup_.platform, aimed, setup_.seed)) {
    admitted.push_back({pose, 0, way_m(current, pose)});
  }
  detail::share_work(admitted.size(), static_cast<std::size_t>(setup_.threads), [&](std::size_t i) {
    admitted[i].shows = UnseenSurface::weight_of(surface_->expected(admitted[i].pose, *rays_));
  });
  return admitted;
}

// Those that show most for their cost first.
VANTAGE_INLINE std::vector<std::size_t> ObjectPlanner::order_of(const std::vector<Candidate>& tried) const {
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const double view_m = options_.view_price * shells_.radii_m.front();
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return static_cast<double>(tried[a].shows) * (view_m + tried[b].way_m) >
           static_cast<double>(tried[b].shows) * (view_m + tried[a].way_m);
  });
  return order;
}

// The first worthwhile candidate to which there is a way, whose place does not rest and need not.
VANTAGE_INLINE bool ObjectPlanner::take_first(const OccupancyMap& map, const Pose& current,
                                              const std::vector<Candidate>& all,
                                              const std::vector<std::size_t>& worthwhile, Plan& plan) {
  const std::vector<Eigen::Vector3d> refused = detail::refused_by_a_stuck_robot(tried_, current);
  for (const std::size_t i : worthwhile) {
    const Candidate& candidate = all[i];
    if (tried_.rests(map.frame().cell_of(candidate.pose.translation())) ||
        !detail::leads_elsewhere(refused, current.translation(), candidate.pose.translation())) {
      continue;
    }
    auto path = way_around(map, *setup_.platform, current, candidate.pose, shells_.object.centre());
    if (path && tried_.expect(map, *path, {})) {
      plan.outcome = Outcome::Move;
      plan.goal = {candidate.pose, static_cast<double>(candidate.shows)};
      plan.path = std::move(*path);
      plan.reason = "a view of sides of the object that were not seen, of weight " + std::to_string(candidate.shows);
      return true;
    }
  }
  return false;
}

VANTAGE_INLINE Plan ObjectPlanner::plan(const OccupancyMap& map, const Pose& pose) {
  detail::Stopwatch stopwatch;
  const Pose current = orthonormalised(pose);
  tried_.review(map, current);
  follow(map, current);
  Plan plan;
  plan.statistics.survey_ms = stopwatch.lap_ms();
  const std::vector<Candidate> all = candidates(map, current);
  plan.statistics.views_scored = all.size();
  plan.statistics.evaluate_ms = stopwatch.lap_ms();

  const double least = std::max(1.0, options_.min_new_share * static_cast<double>(surface_->looked_at()));
  std::vector<std::size_t> worthwhile;
  std::size_t best = 0;
  for (const std::size_t i : order_of(all)) {
    const std::size_t shows = all[i].shows;
    best = std::max(best, shows);
    if (shows > 0) {
      plan.candidates.push_back({all[i].pose, static_cast<double>(shows)});
    }
    if (static_cast<double>(shows) >= least) {
      worthwhile.push_back(i);
    }
  }
  plan.statistics.choose_ms = stopwatch.lap_ms();
  const bool moves = take_first(map, current, all, worthwhile, plan) ||
                     (tried_.try_resting_again() && take_first(map, current, all, worthwhile, plan));
  plan.statistics.path_ms = stopwatch.lap_ms();
  if (moves) {
    return plan;
  }
  if (all.empty()) {
    plan.reason = detail::kNoViewIsAdmitted;
  } else if (worthwhile.empty()) {
    plan.outcome = Outcome::Explored;
    plan.leftover.unobservable = best;
    plan.reason = "no admitted view is expected to show more of the object";
  } else {
    detail::end_without_a_path(map, *setup_.platform, current, tried_, plan);
    plan.leftover.unreachable = best;
  }
  return plan;
}

}  // namespace vantage
