// SPDX-License-Identifier: MIT
//
// Vasquez-Gomez, Sucar, Murrieta-Cid 2013, "Hierarchical ray tracing for fast volumetric next-best-view planning",
// Algorithm 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/raytrace/hierarchical_ray_tracer.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vantage/view/candidate_views.hpp>
#include <vantage/view/view_utility.hpp>

#include "geometry/dice.hpp"
#include "map/option_rule.hpp"
#include "planner/frontier_cycle.hpp"

namespace vantage {
namespace {

void validate(const NextBestViewOptions& options) {
  if (options.object &&
      (options.object->empty() || !options.object->min.allFinite() || !options.object->max.allFinite())) {
    throw std::invalid_argument("NextBestViewOptions::object must have min < max on every axis and be finite");
  }
  detail::require_option(std::isfinite(options.radius_m) && options.radius_m > 0.0, "NextBestViewOptions::radius_m",
                         options.radius_m, "> 0");
  detail::require_option(options.subdivisions >= -1 && options.subdivisions <= 6, "NextBestViewOptions::subdivisions",
                         options.subdivisions, "in [-1, 6]");
  detail::require_option(options.min_unknown_cells >= 1, "NextBestViewOptions::min_unknown_cells",
                         options.min_unknown_cells, ">= 1");
  detail::require_option(options.hierarchical_levels >= 1 && options.hierarchical_levels <= 16,
                         "NextBestViewOptions::hierarchical_levels", options.hierarchical_levels, "in [1, 16]");
  detail::require_option(options.hypotheses >= 1, "NextBestViewOptions::hypotheses", options.hypotheses, ">= 1");
  detail::validate(options.survey);
}

// Where something may be seen: the region, or the known cells and those beside them.
VoxelBox cells_of_interest(const OccupancyMap& map) { return map.region() ? *map.region() : map.bounds().grown(1); }

// The order in which candidates are taken: by utility, ties by number.
struct Rank {
  double utility;
  std::size_t candidate;
  bool exact;  // cells given up are no longer counted

  friend bool operator<(const Rank& a, const Rank& b) {
    return a.utility != b.utility ? a.utility < b.utility : a.candidate > b.candidate;
  }
};

// Line 8: the candidates, in the orientations that the platform can take.
std::vector<Pose> candidates_for(const OccupancyMap& map, const PlannerSetup& setup,
                                 const NextBestViewOptions& options) {
  const Eigen::Vector3d middle = options.object->centre();
  std::vector<Pose> views;
  if (options.subdivisions >= 0) {
    views = views_around(middle, std::array{options.radius_m}, options.subdivisions);
  }
  if (options.random_candidates > 0 && !cells_of_interest(map).empty()) {
    const Box workspace = map.frame().box_of(cells_of_interest(map));
    const std::vector<Pose> random = random_views_of(middle, workspace, options.random_candidates, setup.seed);
    views.insert(views.end(), random.begin(), random.end());
  }
  for (Pose& view : views) {
    view = setup.platform->facing(view.translation(), optical_axis(view));
  }
  return views;
}

// Those of any use, for whoever wants to look.
std::vector<View> views_of(const std::vector<ScoredView>& scored) {
  std::vector<View> views;
  for (const ScoredView& view : scored) {
    if (view.utility > 0.0) {
      views.push_back({view.pose, view.utility});
    }
  }
  return views;
}

// Line 4: straight there or around the object where the platform can go that way, for that is soon known; else by the
// platform's own search.
std::optional<std::vector<Pose>> way_to(const OccupancyMap& map, const Platform& platform, const Pose& from,
                                        const Pose& to, const Eigen::Vector3d& middle) {
  if (platform.admits_motion(map, from, to)) {
    return std::vector<Pose>{from, to};
  }
  const Eigen::Vector3d first = from.translation() - middle;
  const Eigen::Vector3d last = to.translation() - middle;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(first, last);
  constexpr int kSteps = 24;
  std::vector<Pose> arc{from};
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const double radius_m = first.norm() + share * (last.norm() - first.norm());
    const Eigen::Vector3d outwards =
        Eigen::Quaterniond::Identity().slerp(share, turn) * Eigen::Vector3d(first.normalized());
    const Pose next = i == kSteps ? to : platform.facing(middle + radius_m * outwards, -outwards);
    if (!platform.admits(map, next) || !platform.admits_motion(map, arc.back(), next)) {
      return platform.path(map, from, to);
    }
    arc.push_back(next);
  }
  return arc;
}

}  // namespace

NextBestViewPlanner::NextBestViewPlanner(const PlannerSetup& setup, const NextBestViewOptions& options)
    : setup_(setup), options_(options) {
  detail::validate(setup);
  validate(options);
  failed_ = FailedViews(options.survey.patience);
}

Plan NextBestViewPlanner::plan(const OccupancyMap& map, const Pose& current) {
  return options_.object ? reconstruct(map, current) : explore(map, current);
}

void NextBestViewPlanner::follow(const OccupancyMap& map) {
  // At the same address another map may lie now; one that has moved on since is taken for the same.
  if (!caster_ || followed_ != &map || revision_ >= map.revision()) {
    caster_.emplace(map);
    rays_.emplace(setup_.sensor.rays_for(map.resolution_m()));
    followed_ = &map;
  } else {
    caster_->update();
  }
  revision_ = map.revision();
}

// Lines 9 to 20: what every candidate is worth.
std::vector<ScoredView> NextBestViewPlanner::score(const OccupancyMap& map, const Pose& current,
                                                   const VoxelBox& object) const {
  const Platform& platform = *setup_.platform;
  bool any_known = false;
  for_each_cell(object,
                [&](const VoxelIndex& cell) { any_known = any_known || map.at(cell) == Occupancy::Occupied; });
  UtilityFactors factors;
  factors.position = [&](const Pose& pose) { return platform.admits(map, pose); };
  factors.registration = minimum_overlap(any_known ? options_.min_overlap_cells : 0);
  factors.surface = unknown_cells();
  factors.distance = nearness([&](const Pose& pose) { return platform.distance_m(current, pose); });
  return score_views(
      candidates_for(map, setup_, options_),
      [&](std::span<const Pose> views) { return evaluate(map, object, views); }, factors);
}

std::vector<ViewEvaluation> NextBestViewPlanner::evaluate(const OccupancyMap& map, const VoxelBox& object,
                                                          std::span<const Pose> views) const {
  if (options_.method == VisibilityMethod::Exact) {
    return evaluate_views(*caster_, views, *rays_, object, static_cast<std::size_t>(setup_.threads));
  }
  std::vector<ViewEvaluation> evaluations;
  if (options_.method == VisibilityMethod::Uniform) {
    const UniformRayTracer tracer(map);
    for (const Pose& view : views) {
      evaluations.push_back(tracer.evaluate(view, *rays_, object));
    }
    return evaluations;
  }
  const HierarchicalRayTracer tracer(map, setup_.sensor, {.levels = options_.hierarchical_levels});
  for (const Pose& view : views) {
    const HierarchicalCounts counts = tracer.evaluate(view, object);
    evaluations.push_back({counts.unknown, counts.occupied});
  }
  return evaluations;
}

// The unknown cells of the object that a view sees and that have not been given up, and their share of all it sees.
NextBestViewPlanner::Sought NextBestViewPlanner::sought_from(const Pose& pose, const VoxelBox& object) const {
  const VoxelIndex viewpoint = caster_->frame().cell_of(pose.translation());
  Sought sought;
  std::size_t all = 0;
  caster_->visible_cells(pose, *rays_, object).for_each([&](const VoxelIndex& cell) {
    if (caster_->at(cell) == Occupancy::Unknown) {
      ++all;
      if (!failed_.gave_up(cell) && !failed_.failed_from(cell, viewpoint)) {
        sought.cells.push_back(cell);
      }
    }
  });
  sought.share = all == 0 ? 0.0 : static_cast<double>(sought.cells.size()) / static_cast<double>(all);
  return sought;
}

Plan NextBestViewPlanner::reconstruct(const OccupancyMap& map, const Pose& current) {
  detail::Stopwatch stopwatch;
  detail::validate(map, current);
  failed_.review(map, current);
  follow(map);
  const VoxelBox object = map.frame().cells_centred_in(*options_.object);
  Plan plan;
  plan.statistics.survey_ms = stopwatch.lap_ms();
  const std::vector<ScoredView> scored = score(map, current, object);
  std::priority_queue<Rank> ranks;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    if (scored[i].utility > 0.0) {
      ranks.push({scored[i].utility, i, false});
    }
  }
  plan.statistics.views_scored = scored.size();
  plan.candidates = views_of(scored);

  // Line 21. Cells given up only ever lower a utility, so the first exact one at the top is the best.
  CellSet left(object);
  bool any_worthwhile = false;
  while (!ranks.empty()) {
    const Rank top = ranks.top();
    ranks.pop();
    const ScoredView& view = scored[top.candidate];
    auto [sought, share] = sought_from(view.pose, object);
    const bool worthwhile =
        share * static_cast<double>(view.seen.unknown) >= static_cast<double>(options_.min_unknown_cells);
    if (worthwhile && !top.exact) {
      ranks.push({view.utility * share, top.candidate, true});
      continue;
    }
    plan.statistics.choose_ms += stopwatch.lap_ms();
    auto path =
        worthwhile ? way_to(map, *setup_.platform, current, view.pose, options_.object->centre()) : std::nullopt;
    plan.statistics.path_ms += stopwatch.lap_ms();
    if (path) {
      plan.outcome = Outcome::Move;
      plan.goal = {view.pose, top.utility};
      plan.path = std::move(*path);
      plan.reason = "a view of " + std::to_string(sought.size()) + " unknown cells of the object";
      failed_.expect(map, view.pose, sought);
      plan.sought = std::move(sought);
      return plan;
    }
    any_worthwhile = any_worthwhile || worthwhile;
    std::for_each(sought.begin(), sought.end(), [&](const VoxelIndex& cell) { left.insert(cell); });
  }
  // Lines 22 to 25.
  plan.statistics.choose_ms += stopwatch.lap_ms();
  plan.outcome = any_worthwhile ? Outcome::Blocked : Outcome::Explored;
  (any_worthwhile ? plan.leftover.unreachable : plan.leftover.too_small) = left.size();
  plan.reason = any_worthwhile ? "there is no way to any view that sees enough of the object"
                               : "no admitted view sees " + std::to_string(options_.min_unknown_cells) +
                                     " unknown cells of the object; all together see " + std::to_string(left.size());
  return plan;
}

Plan NextBestViewPlanner::explore(const OccupancyMap& map, const Pose& current) {
  detail::FrontierCycle cycle(map, current, setup_, options_.survey, failed_);
  if (cycle.over()) {
    return cycle.plan();
  }
  follow(map);
  const FrontierSurvey& survey = cycle.survey();
  const Platform& platform = *setup_.platform;
  PlanStatistics& statistics = cycle.plan().statistics;
  Dice dice(setup_.seed, map.revision());
  std::vector<Pose> candidates;
  for (std::size_t i = 0; i < options_.hypotheses; ++i) {
    if (i % 2 == 0) {
      const FrontierTarget& target = survey.targets[dice.below(survey.targets.size())];
      const Eigen::Vector3d from = map.frame().centre_of(target.viewpoint);
      candidates.push_back(platform.facing(from, map.frame().centre_of(target.unknown) - from));
    } else {
      const VoxelIndex& cell = survey.reachable.cells()[dice.below(survey.reachable.size())];
      candidates.push_back(platform.facing(map.frame().centre_of(cell), dice.direction()));
    }
  }
  UtilityFactors factors;
  factors.surface = unknown_cells();
  factors.distance = nearness([&](const Pose& pose) { return platform.distance_m(current, pose); });
  const std::vector<ScoredView> scored = score_views(*caster_, candidates, *rays_, cells_of_interest(map), factors,
                                                     static_cast<std::size_t>(setup_.threads));
  statistics.views_scored = scored.size();
  cycle.plan().candidates = views_of(scored);
  std::priority_queue<Rank> ranks;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    ranks.push({scored[i].utility, i, false});
  }
  // A view counts only if it resolves a frontier that is worth one: unknown cells on surfaces worn away are not.
  TargetView best;
  for (; !ranks.empty() && best.unknown.empty(); ranks.pop()) {
    const ScoredView& view = scored[ranks.top().candidate];
    best = targets_seen_from(map, setup_.sensor, survey, view.pose, statistics.ray_operations);
    best.view.utility = view.utility;
  }
  for (std::size_t i = 0; i < survey.targets.size() && best.unknown.empty(); ++i) {
    best = view_of_target(map, platform, setup_.sensor, survey, survey.targets[i], statistics.ray_operations);
  }
  if (best.unknown.empty()) {
    return cycle.blocked("no pose tried sees a frontier");
  }
  const std::vector<VoxelIndex> way =
      GridPaths(survey.reachable).to(map.frame().cell_of(best.view.pose.translation()));
  return cycle.go(std::move(best), way);
}

}  // namespace vantage
