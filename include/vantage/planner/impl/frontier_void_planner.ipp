// SPDX-License-Identifier: MIT
#pragma once

// Dornhege & Kleiner 2011, "A Frontier-Void-Based Approach for Autonomous Exploration in 3D", section IV.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vantage/planner/frontier_void_planner.hpp>

#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/raytrace/impl/shared_work.hpp>

namespace vantage {
namespace detail {

inline std::string volume(std::size_t cells, double cell_m) {
  const double litres = static_cast<double>(cells) * std::pow(10.0 * cell_m, 3);
  const std::string tenths = std::to_string(std::llround(10.0 * litres));
  return std::to_string(cells) + " void cells (" + (tenths.size() > 1 ? tenths.substr(0, tenths.size() - 1) : "0") +
         "." + tenths.back() + " dm^3)";
}

inline std::size_t expected(const std::vector<SightedCell>& seen) {
  double cells = 0.0;
  for (const SightedCell& one : seen) {
    cells += one.chance;
  }
  return static_cast<std::size_t>(std::llround(cells));
}

inline double length_m(const std::vector<Pose>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length_m += (path[i].translation() - path[i - 1].translation()).norm();
  }
  return length_m;
}

// At least one cell.
inline std::size_t least_cells(double volume_m3, double cell_m) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(volume_m3 / std::pow(cell_m, 3))));
}

}  // namespace detail

VANTAGE_INLINE FrontierVoidPlanner::FrontierVoidPlanner(const PlannerSetup& setup, const FrontierVoidOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::frontier_void_settings().validate(options);
  options_.clusters.seed = setup.seed;
}

VANTAGE_INLINE void FrontierVoidPlanner::prepare(Plan& plan) {
  void_cells_.follow(situation().map());
  plan.statistics.void_cells = void_cells_->cell_count();
  search_ = {};
}

VANTAGE_INLINE std::optional<ChosenView> FrontierVoidPlanner::choose(Plan& plan) {
  const OccupancyMap& map = situation().map();
  PlanStatistics& statistics = plan.statistics;
  search_ = {};
  extract();
  accumulate(statistics);

  std::vector<Pose> views = sample_views(statistics);
  const std::vector<Pose> near = near_views(statistics);
  views.insert(views.end(), near.begin(), near.end());
  std::optional<ChosenView> choice = best_of(views, plan);
  if (!choice) {
    choice = best_of(views_of_voids(statistics), plan);
  }
  if (choice) {
    search_.view = choice->view.view.pose;
    choice->reason =
        "a view of " + detail::volume(static_cast<std::size_t>(choice->view.view.utility), map.resolution_m());
    return choice;
  }
  if (!options_.strategy.beyond_voids) {
    const std::size_t least = detail::least_cells(options_.strategy.least_view_m3, map.resolution_m());
    plan.reason = (least == 1 ? "no view sees a void (the best utility is 0); "
                              : "the best utility is below " + detail::volume(least, map.resolution_m()) + "; ") +
                  std::to_string(situation().survey().targets.size()) + " observable frontier cells are left";
    return std::nullopt;
  }
  choice = nearest_view(situation(), statistics.ray_operations);
  choice->view.view.utility = 0.0;
  choice->reason = "no view sees a void; a view of " + std::to_string(choice->view.unknown.size()) + " unknown cells";
  return choice;
}

// IV-A and IV-B: void clusters, frontier clusters and their combination.
VANTAGE_INLINE void FrontierVoidPlanner::extract() {
  const OccupancyMap& map = situation().map();
  const FrontierSurvey& survey = situation().survey();
  for (const FrontierTarget& target : survey.targets) {
    search_.frontier.push_back(target.frontier);
  }
  const std::vector<VoxelIndex> cells = void_cells_->cells_behind(situation().frontier().cells());
  search_.voids = cluster_void_cells(cells, map.frame(), options_.clusters);
  sight_.emplace(map, cells,
                 UnknownSightOptions{options_.strategy.opaque_share, options_.strategy.opaque_beside_surface,
                                     situation().sensor().reports_no_return});
  search_.frontier_voids =
      combine_frontier_voids(search_.voids, frontier_clusters(search_.frontier), options_.strategy.share);
}

// Algorithm 1, over the reachable cells.
VANTAGE_INLINE void FrontierVoidPlanner::accumulate(PlanStatistics& statistics) {
  const OccupancyMap& map = situation().map();
  const std::vector<UtilityVector> vectors =
      utility_vectors(search_.voids, search_.frontier_voids, map.frame(), options_.most_vectors);
  const AccumulatedUtility utility = accumulate_utility(
      map, situation().reachable(), vectors, situation().sensor().min_range_m, situation().sensor().max_range_m);
  statistics.ray_operations += utility.operations;
  for (const auto& [cell, value] : utility.cells) {
    search_.places.push_back(cell);
    search_.utility.push_back(value);
  }
}

VANTAGE_INLINE double FrontierVoidPlanner::discounted(double utility, double way_m) const {
  return utility / (1.0 + options_.strategy.cost_per_m * way_m);
}

// The void cells that count for a view: not given up, and not looked at in vain from its place.
VANTAGE_INLINE std::vector<SightedCell> FrontierVoidPlanner::void_cells_seen(const Pose& view, const ViewRays& rays,
                                                                             std::uint64_t& operations) const {
  const VoxelIndex place = situation().caster().frame().cell_of(view.translation());
  std::vector<SightedCell> seen = sight_->look(situation().caster(), view, rays, operations);
  const TriedViews& tried = situation().tried();
  if (tried.size() > 0) {
    std::erase_if(seen, [&](const SightedCell& one) { return tried.hoped_in_vain(one.cell, place); });
  }
  return seen;
}

// Counts the void cells of each view and sorts the views, best first.
VANTAGE_INLINE std::vector<FrontierVoidPlanner::Candidate> FrontierVoidPlanner::rank(
    std::vector<Candidate> candidates, const ViewRays& rays, std::uint64_t& operations) const {
  (void)situation().caster();  // updates the caster before several threads use it
  detail::share_work(candidates.size(), static_cast<std::size_t>(situation().setup().threads), [&](std::size_t i) {
    Candidate& candidate = candidates[i];
    candidate.operations = 0;
    candidate.void_cells = detail::expected(void_cells_seen(candidate.pose, rays, candidate.operations));
    candidate.value = discounted(static_cast<double>(candidate.void_cells),
                                 (candidate.pose.translation() - situation().current().translation()).norm());
  });
  for (const Candidate& candidate : candidates) {
    operations += candidate.operations;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  return candidates;
}

// Equation (3): the best view to which a path leads. A view must also see a target, because cells that are given up
// or rest are none.
VANTAGE_INLINE std::optional<ChosenView> FrontierVoidPlanner::best_of(const std::vector<Pose>& views,
                                                                      Plan& plan) const {
  plan.statistics.views_scored += views.size();
  std::vector<Candidate> candidates(views.size());
  std::transform(views.begin(), views.end(), candidates.begin(), [](const Pose& pose) { return Candidate{pose}; });
  if (views.size() > options_.strategy.finalists) {
    candidates = rank(std::move(candidates), situation().sparse_rays(), plan.statistics.ray_operations);
    candidates.resize(options_.strategy.finalists);
  }
  candidates = rank(std::move(candidates), situation().rays(), plan.statistics.ray_operations);
  const std::size_t least = detail::least_cells(options_.strategy.least_view_m3, situation().map().resolution_m());
  std::optional<ChosenView> best;
  double best_value = 0.0;
  for (const Candidate& candidate : candidates) {
    if (best && candidate.value <= best_value) {
      break;  // the discounted value along a path is at most that of the straight line
    }
    if (candidate.void_cells < least) {
      continue;
    }
    TargetView view = targets_seen_from(situation(), candidate.pose, plan.statistics.ray_operations);
    auto path = view.unknown.empty() ? std::nullopt : path_to(candidate.pose);
    if (!path) {
      continue;
    }
    const double value = options_.strategy.along_way
                             ? discounted(static_cast<double>(candidate.void_cells), detail::length_m(*path))
                             : candidate.value;
    if (!best || value > best_value) {
      view.view.utility = static_cast<double>(candidate.void_cells);
      best = ChosenView{std::move(view), std::move(*path)};
      best_value = value;
    }
  }
  if (best) {
    for (const SightedCell& one :
         void_cells_seen(best->view.view.pose, situation().rays(), plan.statistics.ray_operations)) {
      (one.chance >= options_.strategy.sought_chance ? best->view.unknown : best->view.hoped).push_back(one.cell);
    }
    plan.candidates.clear();
    for (const Candidate& weighed : candidates) {
      plan.candidates.push_back({weighed.pose, static_cast<double>(weighed.void_cells)});
    }
  }
  return best;
}

}  // namespace vantage
