// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/planner/object_planner.hpp>
#include <vantage/planner/way_around.hpp>
#include <vantage/view/candidate_views.hpp>

#include "map/option_rule.hpp"
#include "planner/stopwatch.hpp"
#include "raytrace/shared_work.hpp"

namespace vantage {
namespace {

void check(const ObjectPlannerOptions& options) {
  if (options.object.empty() || !options.object.min.allFinite() || !options.object.max.allFinite()) {
    throw std::invalid_argument("ObjectPlannerOptions::object must have min < max on every axis and be finite");
  }
  if (options.radii_m.empty()) {
    throw std::invalid_argument("ObjectPlannerOptions::radii_m is empty, must have at least one radius");
  }
  for (const double radius_m : options.radii_m) {
    detail::require_option(std::isfinite(radius_m) && radius_m > 0.0, "ObjectPlannerOptions::radii_m", radius_m,
                           "> 0");
  }
  detail::require_option(options.subdivisions >= -1 && options.subdivisions <= 6,
                         "ObjectPlannerOptions::subdivisions", options.subdivisions, "in [-1, 6]");
  detail::require_option(options.min_new_share >= 0.0 && options.min_new_share < 1.0,
                         "ObjectPlannerOptions::min_new_share", options.min_new_share, "in [0, 1)");
  detail::require_option(options.near_share > 0.0 && options.near_share <= 1.0, "ObjectPlannerOptions::near_share",
                         options.near_share, "in (0, 1]");
  validate(options.aimed);
}

}  // namespace

ObjectPlanner::ObjectPlanner(const PlannerSetup& setup, const ObjectPlannerOptions& options)
    : setup_(setup),
      options_(options),
      tried_(setup.sensor,
             {.goal_tolerance_m = setup.goal_tolerance_m, .goal_tolerance_rad = setup.goal_tolerance_rad}) {
  setup.validate();
  check(options);
}

// Assumes that a new revision is a scan at `current`.
void ObjectPlanner::follow(const OccupancyMap& map, const Pose& current) {
  const bool known = map_.is_in_place(map);
  if (!known) {
    map_ = KnownMap();
    surface_.emplace(map, map.frame().cells_centred_in(options_.object));
    rays_.emplace(setup_.sensor.rays_for(map.resolution_m()));
    map_ = KnownMap(map);
  }
  if (!known || map.revision() != revision_) {
    surface_->look(map, current, *rays_);
    revision_ = map.revision();
  }
}

// Estimated path length, metres: straight, or along an arc if the object is in between.
double ObjectPlanner::way_m(const Pose& from, const Pose& to) const {
  const Eigen::Vector3d a = from.translation() - options_.object.centre();
  const Eigen::Vector3d b = to.translation() - options_.object.centre();
  const Eigen::Vector3d half = 0.5 * options_.object.extent();
  bool through = false;
  for (int i = 1; i < 16 && !through; ++i) {
    through = ((a + (b - a) * (i / 16.0)).cwiseAbs().array() < half.array()).all();
  }
  if (!through) {
    return setup_.platform->distance_m(from, to);
  }
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 0.5 * (a.norm() + b.norm()) + std::abs(a.norm() - b.norm());
}

std::vector<ObjectPlanner::Candidate> ObjectPlanner::candidates(const OccupancyMap& map, const Pose& current) const {
  std::vector<Pose> views;
  const auto add = [&](const std::vector<Pose>& more) { views.insert(views.end(), more.begin(), more.end()); };
  if (options_.subdivisions >= 0) {
    add(views_around(options_.object.centre(), options_.radii_m, options_.subdivisions));
  }
  const VoxelBox cells = map.region() ? *map.region() : map.bounds().grown(1);
  if (options_.random_candidates > 0 && !cells.empty()) {
    add(random_views_of(options_.object.centre(), map.frame().box_of(cells), options_.random_candidates,
                        setup_.seed));
  }
  if (options_.aimed.count > 0) {
    add(aimed_views(surface_->caster(), surface_->left(), options_.aimed, setup_.seed));
  }
  std::vector<Candidate> admitted;
  for (const Pose& view : views) {
    const Pose pose = setup_.platform->facing(view.translation(), optical_axis(view));
    if (setup_.platform->admits(map, pose)) {
      admitted.push_back({pose, {}, way_m(current, pose)});
    }
  }
  detail::share_work(admitted.size(), static_cast<std::size_t>(setup_.threads),
                     [&](std::size_t i) { admitted[i].faces = surface_->expected(admitted[i].pose, *rays_); });
  return admitted;
}

// The nearest of the good ones first, then the others as they are good.
std::vector<std::size_t> ObjectPlanner::order_of(const std::vector<Candidate>& tried) const {
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tried[a].faces.size() > tried[b].faces.size(); });
  const auto good = std::find_if(order.begin(), order.end(), [&](std::size_t i) {
    return static_cast<double>(tried[i].faces.size()) <
           options_.near_share * static_cast<double>(tried[order.front()].faces.size());
  });
  std::stable_sort(order.begin(), good,
                   [&](std::size_t a, std::size_t b) { return tried[a].way_m < tried[b].way_m; });
  return order;
}

// The first worthwhile candidate to which there is a way and whose place does not rest.
bool ObjectPlanner::take_first(const OccupancyMap& map, const Pose& current, const std::vector<Candidate>& all,
                               const std::vector<std::size_t>& worthwhile, Plan& plan) const {
  for (const std::size_t i : worthwhile) {
    const Candidate& candidate = all[i];
    if (tried_.rests(map.frame().cell_of(candidate.pose.translation()))) {
      continue;
    }
    if (auto path = way_around(map, *setup_.platform, current, candidate.pose, options_.object.centre())) {
      plan.outcome = Outcome::Move;
      plan.goal = {candidate.pose, static_cast<double>(candidate.faces.size())};
      plan.path = std::move(*path);
      plan.reason = "a view of " + std::to_string(candidate.faces.size()) + " faces of the object that were not seen";
      return true;
    }
  }
  return false;
}

Plan ObjectPlanner::plan(const OccupancyMap& map, const Pose& pose) {
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
    const std::size_t faces = all[i].faces.size();
    best = std::max(best, faces);
    if (faces > 0) {
      plan.candidates.push_back({all[i].pose, static_cast<double>(faces)});
    }
    if (static_cast<double>(faces) >= least) {
      worthwhile.push_back(i);
    }
  }
  plan.statistics.choose_ms = stopwatch.lap_ms();
  if (take_first(map, current, all, worthwhile, plan) ||
      (tried_.try_resting_again() && take_first(map, current, all, worthwhile, plan))) {
    tried_.expect(map, plan.goal.pose, way_of(plan.path), {});
  } else if (all.empty()) {
    plan.reason =
        "the platform admits none of the candidate views: declare the space around the object free (assume_free)";
  } else if (worthwhile.empty()) {
    plan.outcome = Outcome::Explored;
    plan.leftover.unobservable = best;
    plan.reason = "no admitted view would show more of the object";
  } else {
    plan.outcome = Outcome::Unreachable;
    plan.leftover.unreachable = best;
    plan.reason = "there is no way to any view that would show more of the object";
  }
  plan.statistics.path_ms = stopwatch.lap_ms();
  return plan;
}

}  // namespace vantage
