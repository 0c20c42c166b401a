// SPDX-License-Identifier: MIT
#pragma once

// Dornhege & Kleiner 2011, "A Frontier-Void-Based Approach for Autonomous Exploration in 3D", section IV.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/view/utility_vectors.hpp>
#include <vantage/view/void_views.hpp>

#include <vantage/geometry/impl/box_around.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/planner/impl/void_method.hpp>
#include <vantage/view/impl/ranked_views.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kMostVectors = 50'000;  // see utility_vectors
// Targets that are considered at once, the nearest ones, if far ones count less: views are discounted by distance.
inline constexpr std::size_t kNearTargets = 20'000;
// Views of targets that are tested before the planner concludes that no view sees a void.
inline constexpr std::size_t kProofViews = 50;
// Number of views whose cells in sight are kept. So memory does not grow with the number of views.
inline constexpr std::size_t kRememberedViews = 10;

inline std::string volume(double cells, double cell_m) {
  const double litres = cells * std::pow(10.0 * cell_m, 3);
  const std::string tenths = std::to_string(std::llround(10.0 * litres));
  return std::to_string(std::llround(cells)) + " void cells (" +
         (tenths.size() > 1 ? tenths.substr(0, tenths.size() - 1) : "0") + "." + tenths.back() + " dm^3)";
}

// A whole number of cells.
inline double expected(const std::vector<SightedCell>& seen) {
  const auto add = [](double cells, const SightedCell& one) { return cells + one.chance; };
  return std::round(std::accumulate(seen.begin(), seen.end(), 0.0, add));
}

// The frontier cells of the targets nearest to a position, in the same order.
inline std::vector<VoxelIndex> nearest_frontier(std::span<const FrontierTarget> targets, const VoxelFrame& frame,
                                                const Eigen::Vector3d& here, std::size_t most) {
  std::vector<std::pair<double, std::size_t>> nearest;
  nearest.reserve(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    nearest.emplace_back((frame.centre_of(targets[i].frontier) - here).squaredNorm(), i);
  }
  if (most < nearest.size()) {
    std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(most), nearest.end());
    nearest.resize(most);
    std::sort(nearest.begin(), nearest.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  }
  std::vector<VoxelIndex> cells;
  cells.reserve(nearest.size());
  for (const auto& [distance, i] : nearest) {
    cells.push_back(targets[i].frontier);
  }
  return cells;
}

// At least one cell.
inline double least_cells(double volume_m3, double cell_m) {
  return std::max(1.0, std::ceil(volume_m3 / std::pow(cell_m, 3)));
}

}  // namespace detail

VANTAGE_INLINE FrontierVoidPlanner::FrontierVoidPlanner(const PlannerSetup& setup, const FrontierVoidOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::frontier_void_settings().validate(options);
  options_.clusters.seed = setup.seed;
  clusters_ = VoidClusterTracker(options_.clusters);
}

VANTAGE_INLINE PlanStatistics FrontierVoidPlanner::prepare(const Situation& situation) {
  const OccupancyMap& map = situation.map();
  if (void_cells_.follow(map) || clustered_ != map.revision()) {
    sight_.reset();
  }
  clear_search();
  return {.void_cells = void_cells_->cell_count()};
}

// Clears all but the clusters.
VANTAGE_INLINE void FrontierVoidPlanner::clear_search() {
  VoidClusters voids = std::move(search_.voids);
  search_ = {};
  search_.voids = std::move(voids);
}

VANTAGE_INLINE Choice FrontierVoidPlanner::choose(const Situation& situation) {
  const double cell_m = situation.map().resolution_m();
  const std::size_t all = situation.survey().targets.size();
  std::size_t most = options_.strategy.cost_per_m > 0.0 ? std::min(detail::kNearTargets, all) : all;
  Choice choice;
  choose_view_of_voids(situation, most, choice);
  while (!choice.view && most < all) {
    most = std::min(4 * most, all);
    choose_view_of_voids(situation, most, choice);
  }
  if (choice.view) {
    search_.view = choice.view->view.pose;
    choice.reason = "a view of " + detail::volume(choice.view->view.utility, cell_m);
  } else if (options_.strategy.beyond_voids) {
    choice = nearest_view(situation, choice.statistics);
    choice.reason =
        "no view sees a void; a view of " + std::to_string(choice.view->unknown.size()) + " unknown cells";
    choice.view->view.utility = 0.0;
  } else {
    const bool any_void = detail::least_cells(options_.strategy.least_view_m3, cell_m) == 1.0;
    choice.reason = (any_void ? "no view sees a void (the best utility is 0; beyond_voids=true goes on); "
                              : "the best utility is below least_view_m3 (a smaller one goes on); ") +
                    std::to_string(all) + " observable frontier cells are left";
  }
  return choice;
}

// Takes the best view of voids behind the nearest of the targets, if there is one.
VANTAGE_INLINE void FrontierVoidPlanner::choose_view_of_voids(const Situation& situation, std::size_t most_targets,
                                                              Choice& choice) {
  const std::vector<double> values = search_places(situation, most_targets, choice.statistics);
  const VoidViews of_voids(situation.surveyed(), search_.voids, choice.statistics.ray_operations);
  std::vector<Pose> views = of_voids.draw(search_.places, values, search_.frontier_voids,
                                          detail::VoidMethod::of(options_.strategy.mode).sampling,
                                          options_.strategy.views, situation.setup().seed);
  // Where far views count less, the goal ahead gains with every step. So a robot that plans on its way does not turn
  // to and fro.
  if (const auto goal = situation.goal_ahead(); goal && options_.strategy.cost_per_m > 0.0) {
    views.push_back(*goal);
  }
  choose_best(situation, views, choice);
  if (!choice.view) {
    choose_best(situation, of_voids.of_targets(std::min(options_.strategy.views, detail::kProofViews)), choice);
  }
}

// IV-A and IV-B: void clusters, frontier clusters and their combination. Algorithm 1, over the reachable cells: the
// places. Returns what each place counts.
VANTAGE_INLINE std::vector<double> FrontierVoidPlanner::search_places(const Situation& situation,
                                                                      std::size_t most_targets,
                                                                      PlanStatistics& statistics) {
  const OccupancyMap& map = situation.map();
  const RangeSensor& sensor = situation.sensor();
  const detail::VoidMethod method = detail::VoidMethod::of(options_.strategy.mode);
  const Eigen::Vector3d here = situation.current().translation();
  clear_search();
  search_.frontier = detail::nearest_frontier(situation.survey().targets, map.frame(), here, most_targets);
  std::vector<VoxelBox> near = detail::boxes_around(search_.frontier, map.frame().cells_up_to(sensor.max_range_m));
  if (!sight_ || near != near_) {  // else a view in this map was refused, and only the targets have changed
    near_ = std::move(near);
    const BrickSet cells = void_cells_->cells_behind(situation.frontier_cells(), near_);
    search_.voids = method.in_tiles ? clusters_.update(cells, map.frame())
                                    : cluster_void_cells(cells.cells(), map.frame(), options_.clusters);
    clustered_ = map.revision();
    sight_.emplace(map, cells,
                   UnknownSightOptions{method.opaque_share, method.opaque_beside_surface, sensor.reports_no_return});
  }
  search_.frontier_voids = combine_frontier_voids(search_.voids, frontier_clusters(search_.frontier), method.share);
  const AccumulatedUtility utility =
      accumulate_utility(map, situation.reachable(),
                         utility_vectors(search_.voids, search_.frontier_voids, map.frame(), detail::kMostVectors),
                         sensor.min_range_m, sensor.max_range_m);
  statistics.ray_operations += utility.operations;
  std::vector<double> values;
  for (const auto& [cell, value] : utility.cells) {
    search_.places.push_back(cell);
    search_.utility.push_back(value);
    values.push_back(
        worth(static_cast<double>(value), options_.strategy.cost_per_m, (map.frame().centre_of(cell) - here).norm()));
  }
  return values;
}

// The void cells that count for a view: not given up, and not looked at in vain from its place.
VANTAGE_INLINE std::vector<SightedCell> FrontierVoidPlanner::void_cells_seen(const Situation& situation,
                                                                             const Pose& view, const ViewRays& rays,
                                                                             std::uint64_t& operations) const {
  const VoxelIndex place = situation.map().frame().cell_of(view.translation());
  std::vector<SightedCell> seen = sight_->look(situation.looking().caster(), view, rays, operations);
  std::erase_if(seen, [&](const SightedCell& one) { return situation.tried().hoped_in_vain(one.cell, place); });
  return seen;
}

// Equation (3): the best view to which a path leads. A view must also see a target: cells that are given up
// or rest are no targets.
VANTAGE_INLINE void FrontierVoidPlanner::choose_best(const Situation& situation, const std::vector<Pose>& views,
                                                     Choice& choice) const {
  const detail::VoidMethod method = detail::VoidMethod::of(options_.strategy.mode);
  const Eigen::Vector3d here = situation.current().translation();
  choice.statistics.views_scored += views.size();
  std::vector<Candidate> candidates(views.size());
  std::transform(views.begin(), views.end(), candidates.begin(), [](const Pose& pose) { return Candidate{{pose}}; });
  const FollowingCaster& looking = situation.looking();
  detail::rank_views(
      looking, situation.setup().threads, candidates, method.finalists, method.best, choice.statistics.ray_operations,
      [&](Candidate& candidate, const ViewRays& rays) {
        View& view = candidate.view;
        std::vector<SightedCell> seen = void_cells_seen(situation, view.pose, rays, candidate.operations);
        view.utility = detail::expected(seen);
        candidate.value = worth(view.utility, options_.strategy.cost_per_m, (view.pose.translation() - here).norm());
        if (&rays == &looking.rays() && candidates.size() <= detail::kRememberedViews) {
          candidate.seen = std::move(seen);
        }
      },
      [](const Candidate& a, const Candidate& b) { return a.value > b.value; });
  const double least = detail::least_cells(options_.strategy.least_view_m3, situation.map().resolution_m());
  for (const Candidate& candidate : candidates) {
    if (candidate.view.utility < least) {
      continue;
    }
    TargetView view = targets_seen_from(situation.surveyed(), candidate.view.pose, choice.statistics.ray_operations);
    auto path = view.unknown.empty() ? std::nullopt : situation.path_to(candidate.view.pose);
    if (!path) {
      continue;
    }
    const std::vector<SightedCell> sees =
        candidate.seen.empty()
            ? void_cells_seen(situation, view.view.pose, looking.rays(), choice.statistics.ray_operations)
            : candidate.seen;
    view.view.utility = detail::expected(sees);
    for (const SightedCell& one : sees) {
      (one.chance >= method.sought_chance ? view.unknown : view.hoped).push_back(one.cell);
    }
    for (const Candidate& weighed : candidates) {
      choice.candidates.push_back(weighed.view);
    }
    choice.view = std::move(view);
    choice.path = std::move(*path);
    return;
  }
}

}  // namespace vantage
