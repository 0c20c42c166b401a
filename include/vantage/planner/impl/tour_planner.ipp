// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vantage/planner/tour_planner.hpp>

#include <vantage/planner/impl/glances.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/planner/impl/tour_legs.hpp>
#include <vantage/planner/impl/tour_views.hpp>
#include <vantage/robot/impl/block_ways.hpp>
#include <vantage/robot/impl/estimated_motion.hpp>
#include <vantage/view/impl/cover_tour.hpp>
#include <vantage/view/impl/frontier_sites.hpp>
#include <vantage/view/impl/open_tour.hpp>
#include <vantage/view/impl/targets_in_sight.hpp>

namespace vantage {
namespace detail {

// Largest length and width of a part of the frontier. Larger clusters of frontier cells are divided.
inline constexpr double kSiteM = 1.5;
// Most parts of the frontier (the nearest) and most views of a tour.
inline constexpr std::size_t kMostSites = 24;
// Views at the front of a tour that are chosen anew for a shorter tour.
inline constexpr std::size_t kRefined = 3;

// The nearest sites, nearest first, and the ways from the start to them and to what is near to them.
struct NearestSites {
  const BlockWays& ways;
  VoxelIndex start;
  std::vector<FrontierSite> sites;
  std::vector<double> lengths;  // see BlockWays::lengths_from

  explicit NearestSites(const Situation& situation) : ways(situation.ways()), start(*situation.reachable().start()) {
    std::vector<FrontierSite> all = frontier_parts(situation, kSiteM);
    std::vector<VoxelIndex> places(all.size());
    std::transform(all.begin(), all.end(), places.begin(),
                   [](const FrontierSite& site) { return site.middle.viewpoint; });
    lengths = ways.lengths_from(start, places, kMostSites);
    std::vector<std::pair<double, std::size_t>> near;
    near.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      near.emplace_back(way_m(places[i]), i);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), kMostSites));
    sites.reserve(near.size());
    for (const auto& [length_m, i] : near) {
      sites.push_back(std::move(all[i]));
    }
  }

  // The length of the way from the start.
  [[nodiscard]] double way_m(const VoxelIndex& place) const { return ways.length_to(place, start, lengths); }
  // The target of a site that is seen from the nearest place.
  [[nodiscard]] const FrontierTarget& nearest_target(const FrontierSite& site) const {
    std::vector<double> ways_m(site.targets.size());
    std::transform(site.targets.begin(), site.targets.end(), ways_m.begin(),
                   [this](const FrontierTarget& target) { return way_m(target.viewpoint); });
    const auto least = std::min_element(ways_m.begin(), ways_m.end()) - ways_m.begin();
    return site.targets[static_cast<std::size_t>(least)];
  }
};

// The views in the order of a tour.
inline std::vector<std::size_t> ordered(const std::vector<std::size_t>& chosen, const Situation& situation,
                                        const std::vector<TourView>& views, TourLegs& legs) {
  const std::size_t n = chosen.size();
  if (n < 2) {
    return chosen;
  }
  OpenTourProblem problem;
  for (std::size_t from = 0; from <= n; ++from) {
    for (const std::size_t to : chosen) {
      problem.legs.push_back(legs.between(from < n ? chosen[from] : views.size(), to));
    }
  }
  problem.shows.assign(n, 1.0);  // a sensor that looks all around sees about half of the rest in passing
  if (!situation.sensor().looks_all_around()) {
    double all = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      problem.shows[i] = static_cast<double>(views[chosen[i]].sees.size());
      all += problem.shows[i];
    }
    for (double& share : problem.shows) {
      share /= all;
    }
  }
  std::vector<std::size_t> tour = detail::open_tour(problem);
  for (std::size_t& view : tour) {
    view = chosen[view];
  }
  return tour;
}

// The cells of the first view of a tour, those that no other view of the tour sees first, and of these the ones in
// the middle of the image.
inline std::vector<VoxelIndex> cells_of_first(const std::vector<std::size_t>& tour, const TourViews& choice,
                                              const VoxelFrame& frame) {
  const TourView& first = choice.views[tour.front()];
  std::vector<bool> seen_later(choice.unknown.size());
  for (std::size_t k = 1; k < tour.size(); ++k) {
    for (const std::uint32_t number : choice.views[tour[k]].sees) {
      seen_later[number] = true;
    }
  }
  struct Ranked {
    bool is_seen_later;
    double off_axis;
    VoxelIndex cell;
  };
  std::vector<Ranked> ranked;
  for (const std::uint32_t number : first.sees) {
    const VoxelIndex& cell = choice.unknown[number];
    const Eigen::Vector3d line = frame.centre_of(cell) - first.pose.translation();
    ranked.push_back({seen_later[number], -line.normalized().dot(optical_axis(first.pose)), cell});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return std::pair(a.is_seen_later, a.off_axis) < std::pair(b.is_seen_later, b.off_axis);
  });
  std::vector<VoxelIndex> cells(ranked.size());
  std::transform(ranked.begin(), ranked.end(), cells.begin(), [](const Ranked& one) { return one.cell; });
  return cells;
}

// The target to which the robot is on its way, if it is still among these sites.
inline const FrontierTarget* target_ahead(const Situation& situation, const std::vector<FrontierSite>& sites) {
  const std::optional<Pose> goal = situation.goal_ahead();
  if (!goal) {
    return nullptr;
  }
  const VoxelIndex place = situation.map().frame().cell_of(goal->translation());
  for (const FrontierSite& site : sites) {
    for (const FrontierTarget& target : site.targets) {
      if (target.viewpoint == place) {
        return &target;
      }
    }
  }
  return nullptr;
}

// For a sensor that sees all around: it need not be aimed, and sees the parts while it passes. So a tour over one
// place for each part is enough: the nearest one that sees a cell of it. Others may lie on the far side, where the
// robot was when they were found.
inline Choice first_sight(const Situation& situation, const NearestSites& nearest, TourCost cost,
                          const Eigen::Vector3d& velocity_m_s) {
  const std::vector<FrontierSite>& sites = nearest.sites;
  std::vector<const FrontierTarget*> targets;
  std::vector<TourView> views;
  for (const FrontierSite& site : sites) {
    targets.push_back(&nearest.nearest_target(site));
    views.push_back({targets.back()->viewpoint, Pose::Identity(), {}});
  }
  TourLegs legs(situation, cost, velocity_m_s, nearest.ways, nearest.lengths, views);
  std::vector<std::size_t> all(views.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const FrontierTarget* first = targets[ordered(all, situation, views, legs).front()];
  // A robot that plans on its way turns to another target only if that is nearer, so it cannot turn to and fro.
  const FrontierTarget* const ahead = target_ahead(situation, sites);
  if (ahead != nullptr && nearest.way_m(ahead->viewpoint) <= nearest.way_m(first->viewpoint)) {
    first = ahead;
  }
  const FrontierTarget& wanted = *first;
  Choice choice{.way = situation.way_to(wanted.viewpoint), .statistics = {.views_scored = views.size()}};
  TargetView view = view_of_target(situation.surveyed(), wanted, choice.statistics.ray_operations);
  choice.reason = "the first of " + std::to_string(sites.size()) + " places of a tour, a view of " +
                  std::to_string(view.unknown.size()) + " unknown cells";
  // Once the wanted cell is known, the tour is planned again: waiting for all cells in view takes longer ways.
  std::erase(view.unknown, wanted.unknown);
  view.hoped = std::exchange(view.unknown, {wanted.unknown});
  choice.view = std::move(view);
  return choice;
}

// For a sensor that must be aimed: views are chosen for what they show.
inline Choice first_view(const Situation& situation, const NearestSites& nearest, const TourViews& sampled,
                         TourCost cost, const Eigen::Vector3d& velocity_m_s, PlanStatistics& statistics) {
  const std::vector<TourView>& views = sampled.views;
  statistics.views_scored += views.size();
  if (views.empty()) {  // what is left is beyond the resolving range, or seen in part
    return nearest_view(situation, statistics);
  }
  TourLegs legs(situation, cost, velocity_m_s, nearest.ways, nearest.lengths, views);
  CoverTourProblem problem;
  problem.per_view = legs.of_stop();
  problem.leg = [&](std::size_t from, std::size_t to) { return legs.between(from, to); };
  for (const TourView& view : views) {
    problem.sees.push_back(view.sees);
  }
  const std::vector<std::size_t> chosen = cover_tour(problem, kMostSites);
  const std::vector<std::size_t> tour = refined_tour(problem, ordered(chosen, situation, views, legs), kRefined);
  const TourView& first = views[tour.front()];
  // Once half of the cells are known, the tour is planned again.
  std::vector<VoxelIndex> cells = cells_of_first(tour, sampled, situation.map().frame());
  const auto half = cells.begin() + static_cast<std::ptrdiff_t>((cells.size() + 1) / 2);
  TargetView view{.view = {.pose = first.pose, .utility = static_cast<double>(cells.size())}};
  view.hoped.assign(half, cells.end());
  cells.erase(half, cells.end());
  view.unknown = std::move(cells);
  Choice choice{.view = std::move(view), .way = situation.way_to(first.place), .statistics = statistics};
  choice.reason = "the first of " + std::to_string(tour.size()) + " views of a tour, a view of " +
                  std::to_string(first.sees.size()) + " unknown cells";
  return choice;
}

}  // namespace detail

VANTAGE_INLINE TourPlanner::TourPlanner(const PlannerSetup& setup, const TourOptions& options)
    : FrontierPlanner(setup, options.survey),
      options_(options),
      motion_(std::make_shared<detail::EstimatedMotion>()) {
  detail::tour_settings().validate(options);
}

VANTAGE_INLINE MotionModel TourPlanner::default_motion() {
  return {.max_speed_m_s = 2.0, .max_acceleration_m_s2 = 3.0, .max_yaw_rate_rad_s = 0.5 * std::numbers::pi};
}

VANTAGE_INLINE Choice TourPlanner::choose(const Situation& situation) {
  const detail::NearestSites nearest(situation);
  const Eigen::Vector3d velocity_m_s = motion_->velocity_at(situation.current().translation());
  std::optional<detail::TourViews> views;
  PlanStatistics statistics;
  if (!situation.sensor().looks_all_around()) {
    views.emplace(situation, nearest.sites, statistics.ray_operations);
  }
  Choice choice = views ? detail::first_view(situation, nearest, *views, options_.cost, velocity_m_s, statistics)
                        : detail::first_sight(situation, nearest, options_.cost, velocity_m_s);
  if (const std::optional<MotionModel>& motion = situation.setup().motion) {
    if (std::optional<std::vector<Pose>> path = situation.path_to(choice.view->view.pose, choice.way)) {
      std::uint64_t& operations = choice.statistics.ray_operations;
      choice.path = views ? detail::with_glances(*path, *views, situation, velocity_m_s, operations) : *path;
      motion_->follow(choice.path, *motion);
    }
  }
  return choice;
}

}  // namespace vantage
