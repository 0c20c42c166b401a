// SPDX-License-Identifier: MIT
#pragma once

// Vasquez-Gomez, Sucar, Murrieta-Cid 2013, "Hierarchical ray tracing for fast volumetric next-best-view planning",
// Algorithm 1.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/way_around.hpp>
#include <vantage/view/view_utility.hpp>

#include <vantage/planner/impl/blocked_reasons.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/planner/impl/stopwatch.hpp>
#include <vantage/raytrace/impl/shared_work.hpp>

namespace vantage {

VANTAGE_INLINE NextBestViewPlanner::NextBestViewPlanner(const PlannerSetup& setup, const NextBestViewOptions& options)
    : setup_(setup),
      options_(options),
      tried_(setup.sensor, {setup.goal_tolerance_m, setup.goal_tolerance_rad, options.patience}) {
  setup.validate();
  detail::next_best_view_settings().validate(options);
  validate(options.sensing);
}

// Line 8: the candidates that the platform admits, in orientations that it can take.
VANTAGE_INLINE std::vector<Pose> NextBestViewPlanner::views(const OccupancyMap& map, const VoxelBox& object) const {
  std::vector<Pose> aimed;
  if (shells_.aimed_candidates > 0) {
    CellSet sought(object);
    for_each_cell(object, [&](const VoxelIndex& cell) {
      if (looking_.caster().at(cell) == Occupancy::Unknown && !tried_.gave_up(cell)) {
        sought.insert(cell);
      }
    });
    aimed = aimed_views(looking_.caster(), sought, shells_.aimed(), setup_.seed);
  }
  std::vector<Pose> views = views_of_object(shells_, map, *setup_.platform, aimed, setup_.seed);
  std::erase_if(views, [&](const Pose& view) { return tried_.rests(map.frame().cell_of(view.translation())); });
  return views;
}

// Whether there are candidates beside the aimed ones, which are none where nothing unknown is in sight.
VANTAGE_INLINE bool NextBestViewPlanner::draws_views() const {
  return shells_.subdivisions >= 0 || shells_.random_candidates > 0;
}

// Lines 9 to 20: the utility of every candidate.
VANTAGE_INLINE std::vector<NextBestViewPlanner::Candidate> NextBestViewPlanner::candidates(
    const OccupancyMap& map, const Pose& current, const VoxelBox& object) const {
  const std::vector<Pose> views = this->views(map, object);
  std::vector<CellSet> seen(views.size());
  std::vector<ViewEvaluation> evaluations(views.size());
  const ObjectVisibility visibility(map, looking_, setup_.sensor, object, options_.method, options_.sensing);
  detail::share_work(views.size(), static_cast<std::size_t>(setup_.threads),
                     [&](std::size_t i) { evaluations[i] = visibility.evaluate(views[i], seen[i]); });
  const std::vector<ScoredView> scored = score(map, current, object, views, evaluations);
  std::vector<Candidate> candidates(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    Candidate& candidate = candidates[i];
    candidate.view = scored[i];
    candidate.sought = CellSet(object);
    const VoxelIndex viewpoint = map.frame().cell_of(views[i].translation());
    std::size_t all = 0;
    seen[i].for_each([&](const VoxelIndex& cell) {
      if (looking_.caster().at(cell) == Occupancy::Unknown) {
        ++all;
        if (!tried_.gave_up(cell) && !tried_.tried_from(cell, viewpoint)) {
          candidate.sought.insert(cell);
        }
      }
    });
    const double share =
        static_cast<double>(candidate.sought.size()) / static_cast<double>(std::max<std::size_t>(all, 1));
    candidate.counted = share * static_cast<double>(candidate.view.seen.unknown);
    candidate.view.utility *= share;
  }
  return candidates;
}

VANTAGE_INLINE std::vector<ScoredView> NextBestViewPlanner::score(const OccupancyMap& map, const Pose& current,
                                                                  const VoxelBox& object, std::span<const Pose> views,
                                                                  const std::vector<ViewEvaluation>& seen) const {
  bool any_known = false;
  for_each_cell(object,
                [&](const VoxelIndex& cell) { any_known = any_known || map.at(cell) == Occupancy::Occupied; });
  UtilityFactors factors;
  factors.registration = minimum_overlap(any_known ? options_.min_overlap_cells : 0);
  factors.surface = unknown_cells();
  factors.distance = nearness([&](const Pose& pose) { return setup_.platform->distance_m(current, pose); });
  const auto scored_by = [&] {
    return score_views(
        views, [&](std::span<const Pose>) { return seen; }, factors);
  };
  if (!options_.gain) {
    return scored_by();
  }
  const ViewGain gain(map, looking_.caster(), looking_.rays(), object, options_.gain(map, object));
  factors.surface = [&](const Pose& pose, const ViewEvaluation& evaluation) {
    return evaluation.unknown == 0 ? 0.0 : gain(pose, static_cast<std::size_t>(setup_.threads));
  };
  std::vector<ScoredView> scored = scored_by();
  if (std::none_of(scored.begin(), scored.end(), [](const ScoredView& view) { return view.utility > 0.0; })) {
    factors.surface = unknown_cells();
    scored = scored_by();
  }
  return scored;
}

// Makes the plan a Move to this view, if a path leads to it that the robot has not failed to follow.
VANTAGE_INLINE void NextBestViewPlanner::take(const OccupancyMap& map, const Pose& current, const ScoredView& view,
                                              const CellSet& sought, Plan& plan) {
  auto path = way_around(map, *setup_.platform, current, view.pose, shells_.object.centre());
  std::vector<VoxelIndex> cells;
  sought.for_each([&](const VoxelIndex& cell) { cells.push_back(cell); });
  if (path && tried_.expect(map, *path, cells)) {
    plan.outcome = Outcome::Move;
    plan.goal = {view.pose, view.utility};
    plan.path = std::move(*path);
    plan.sought = std::move(cells);
    plan.reason = "a view of " + std::to_string(plan.sought.size()) + " unknown cells of the object";
  }
}

VANTAGE_INLINE Plan NextBestViewPlanner::plan(const OccupancyMap& map, const Pose& pose) {
  detail::Stopwatch stopwatch;
  const Pose current = orthonormalised(pose);
  tried_.review(map, current);
  looking_.follow(map, setup_.sensor);
  shells_ = with_radii(options_.candidates, setup_.sensor, *setup_.platform, map.resolution_m());
  const VoxelBox object = map.frame().cells_centred_in(shells_.object);
  Plan plan;
  plan.statistics.survey_ms = stopwatch.lap_ms();
  std::vector<Candidate> tried = candidates(map, current, object);
  plan.statistics.views_scored = tried.size();
  plan.statistics.evaluate_ms = stopwatch.lap_ms();

  const bool none_admitted = tried.empty() && draws_views() && !tried_.any_rests();
  const std::vector<Eigen::Vector3d> refused = detail::refused_by_a_stuck_robot(tried_, current);
  // Line 21: the best view first.
  std::erase_if(tried, [](const Candidate& one) { return one.view.utility <= 0.0; });
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Candidate& a, const Candidate& b) { return a.view.utility > b.view.utility; });
  CellSet left(object);
  bool any_worthwhile = false;
  for (const auto& [view, sought, counted] : tried) {
    plan.candidates.push_back({view.pose, view.utility});
    if (plan.outcome == Outcome::Move) {
      continue;
    }
    left |= sought;
    if (counted < static_cast<double>(options_.min_unknown_cells)) {
      continue;
    }
    any_worthwhile = true;
    if (!detail::leads_elsewhere(refused, current.translation(), view.pose.translation())) {
      continue;
    }
    plan.statistics.choose_ms += stopwatch.lap_ms();
    take(map, current, view, sought, plan);
    plan.statistics.path_ms += stopwatch.lap_ms();
  }
  plan.statistics.choose_ms += stopwatch.lap_ms();
  if (plan.outcome == Outcome::Move) {
    return plan;
  }
  // Lines 22 to 25: no view is taken.
  if (tried_.try_resting_again()) {
    return this->plan(map, current);
  }
  if (none_admitted) {
    plan.reason = detail::kNoViewIsAdmitted;
  } else if (any_worthwhile || tried_.any_rests()) {
    detail::end_without_a_path(map, *setup_.platform, current, tried_, plan);
    plan.leftover.unreachable = left.size();
  } else {
    plan.outcome = Outcome::Explored;
    plan.leftover.unobservable = left.size();
    plan.reason = "no admitted view sees " + std::to_string(options_.min_unknown_cells) +
                  " unknown cells of the object; all together see " + std::to_string(left.size());
  }
  return plan;
}

}  // namespace vantage
