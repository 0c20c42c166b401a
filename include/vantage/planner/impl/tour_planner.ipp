// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vantage/planner/tour_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/planner/impl/block_ways.hpp>
#include <vantage/planner/impl/cover_tour.hpp>
#include <vantage/planner/impl/open_tour.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/planner/impl/tour_views.hpp>
#include <vantage/planner/impl/unknown_ways.hpp>
#include <vantage/view/impl/frontier_sites.hpp>
#include <vantage/view/impl/targets_in_sight.hpp>

namespace vantage {
namespace detail {

// Views at the front of a tour that are chosen anew for a shorter tour.
inline constexpr std::size_t kRefined = 3;

// Blocks of about a metre.
inline std::int32_t side_for(double cell_m) { return cell_m < 0.15 ? 8 : 4; }

inline BlockWays ways_through(const ReachableSpace& space, const VoxelFrame& frame) {
  return BlockWays(frame, side_for(frame.size_m), [&space](const VoxelIndex& brick) {
    const BrickPlane* const cells = space.find(brick);
    return cells == nullptr ? BrickPlane{} : *cells;
  });
}

// The nearest sites, nearest first.
inline std::vector<FrontierSite> nearest_sites(const Situation& situation, const TourOptions& options,
                                               const BlockWays& ways) {
  const VoxelIndex start = *situation.reachable().start();
  std::vector<FrontierSite> sites = detail::frontier_sites(
      situation.survey().targets, std::max(1, situation.map().frame().cells_up_to(options.site_m)));
  std::vector<VoxelIndex> places;
  places.reserve(sites.size());
  for (const FrontierSite& site : sites) {
    places.push_back(site.middle.viewpoint);
  }
  const std::vector<double> lengths = ways.lengths_from(start, places, options.most_sites);
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    near.emplace_back(ways.length_to(sites[i].middle.viewpoint, start, lengths), i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), options.most_sites));
  std::vector<FrontierSite> nearest;
  nearest.reserve(near.size());
  for (const auto& [way_m, i] : near) {
    nearest.push_back(std::move(sites[i]));
  }
  return nearest;
}

// What a tour from the current pose over views costs: metres, or seconds, for each leg the longer of moving and
// turning.
class TourLegs {
 public:
  TourLegs(const Situation& situation, TourCost cost, const BlockWays& ways, const std::vector<TourView>& views)
      : situation_(situation),
        ways_(ways),
        views_(views),
        motion_(situation.setup().motion.value_or(TourPlanner::default_motion())),
        is_time_(cost == TourCost::Time),
        turns_(is_time_ && !situation.sensor().looks_all_around()) {
    for (const TourView& view : views) {
      places_.push_back(view.place);
    }
  }

  [[nodiscard]] double of_way(double way_m) const { return is_time_ ? way_m / motion_.max_speed_m_s : way_m; }
  // Braking for a view and speeding up again.
  [[nodiscard]] double of_stop() const {
    return of_way(motion_.max_speed_m_s * motion_.max_speed_m_s / motion_.max_acceleration_m_s2);
  }
  // From a view, or from the current pose if it is the number of views.
  [[nodiscard]] double between(std::size_t from, std::size_t to) {
    const bool is_start = from == views_.size();
    const VoxelIndex& place = is_start ? *situation_.reachable().start() : views_[from].place;
    auto known = lengths_.find(place);
    if (known == lengths_.end()) {
      known = lengths_.emplace(place, ways_.lengths_from(place, places_)).first;
    }
    const double way = of_way(ways_.length_to(views_[to].place, place, known->second));
    if (!turns_) {
      return way;
    }
    const Pose& pose = is_start ? situation_.current() : views_[from].pose;
    const double cosine = optical_axis(pose).dot(optical_axis(views_[to].pose));
    return std::max(way, motion_.turn_time_s(std::acos(std::clamp(cosine, -1.0, 1.0))));
  }

 private:
  const Situation& situation_;
  const BlockWays& ways_;
  const std::vector<TourView>& views_;
  MotionModel motion_;
  bool is_time_;
  bool turns_;
  std::vector<VoxelIndex> places_;                     // of the views
  std::map<VoxelIndex, std::vector<double>> lengths_;  // from places, as far as they were asked for
};

// The views in the order of a tour: the whole tour counts, less the price of its first view, which is what it would
// cost to come back to it from the unknown.
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
  std::vector<VoxelIndex> places;
  places.reserve(n);
  for (const std::size_t view : chosen) {
    places.push_back(views[view].place);
  }
  const UnknownWays unknown(situation.map(), counted_range_m(situation.map(), situation.sensor()), places);
  for (const std::size_t view : chosen) {
    problem.prices.push_back(legs.of_way(unknown.mean_m(views[view].place)));
  }
  problem.leg_weights.assign(n, 1.0);
  problem.price_weights.assign(n, 0.0);
  problem.price_weights.front() = -1.0;
  std::vector<std::size_t> tour;
  for (const std::size_t i : detail::open_tour(problem)) {
    tour.push_back(chosen[i]);
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
  std::vector<VoxelIndex> cells;
  cells.reserve(ranked.size());
  for (const Ranked& one : ranked) {
    cells.push_back(one.cell);
  }
  return cells;
}

// The target of a site that is seen from the nearest place.
inline const FrontierTarget& nearest_target(const Situation& situation, const FrontierSite& site,
                                            const BlockWays& ways) {
  const VoxelIndex start = *situation.reachable().start();
  std::vector<VoxelIndex> places;
  places.reserve(site.targets.size());
  for (const FrontierTarget& target : site.targets) {
    places.push_back(target.viewpoint);
  }
  const std::vector<double> lengths = ways.lengths_from(start, places);
  std::vector<double> way_m;
  way_m.reserve(places.size());
  for (const VoxelIndex& place : places) {
    way_m.push_back(ways.length_to(place, start, lengths));
  }
  return site.targets[static_cast<std::size_t>(std::min_element(way_m.begin(), way_m.end()) - way_m.begin())];
}

// For a sensor that sees all around: it need not be aimed, and sees the parts while it passes. So a tour over their
// middles is enough, and ends at the first place that sees a cell of the first part.
inline ChosenView first_sight(const Situation& situation, const std::vector<FrontierSite>& sites, TourCost cost,
                              const BlockWays& ways, Plan& plan) {
  std::vector<TourView> middles;
  middles.reserve(sites.size());
  for (const FrontierSite& site : sites) {
    middles.push_back({site.middle.viewpoint, Pose::Identity(), {}});
  }
  plan.statistics.views_scored += middles.size();
  TourLegs legs(situation, cost, ways, middles);
  std::vector<std::size_t> all(middles.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const FrontierSite& first = sites[ordered(all, situation, middles, legs).front()];
  const FrontierTarget& wanted = nearest_target(situation, first, ways);
  ChosenView chosen{.view = view_of_target(situation.surveyed(), wanted, plan.statistics.ray_operations),
                    .way = GridPaths(situation.reachable()).to(wanted.viewpoint)};
  // Once the wanted cell is known, the tour is planned again: waiting for all cells in view takes longer ways.
  TargetView& view = chosen.view;
  chosen.reason = "the first of " + std::to_string(sites.size()) + " places of a tour, a view of " +
                  std::to_string(view.unknown.size()) + " unknown cells";
  std::erase(view.unknown, wanted.unknown);
  view.hoped = std::exchange(view.unknown, {wanted.unknown});
  return chosen;
}

// For a sensor that must be aimed: views are chosen for what they show.
inline ChosenView first_view(const Situation& situation, const std::vector<FrontierSite>& sites,
                             const TourOptions& options, const BlockWays& ways, Plan& plan) {
  const TourViews choice(situation, sites, plan.statistics.ray_operations);
  plan.statistics.views_scored += choice.views.size();
  if (choice.views.empty()) {  // what is left is beyond the resolving range, or seen in part
    return nearest_view(situation, plan.statistics.ray_operations);
  }
  TourLegs legs(situation, options.cost, ways, choice.views);
  CoverTourProblem problem;
  problem.per_view = legs.of_stop();
  problem.leg = [&](std::size_t from, std::size_t to) { return legs.between(from, to); };
  for (const TourView& view : choice.views) {
    problem.sees.push_back(view.sees);
  }
  const std::vector<std::size_t> chosen = cover_tour(problem, options.most_sites);
  const std::vector<std::size_t> tour =
      refined_tour(problem, ordered(chosen, situation, choice.views, legs), kRefined);
  const TourView& first = choice.views[tour.front()];
  // Once half of the cells are known, the tour is planned again.
  std::vector<VoxelIndex> cells = cells_of_first(tour, choice, situation.map().frame());
  const auto half = cells.begin() + static_cast<std::ptrdiff_t>((cells.size() + 1) / 2);
  ChosenView view{.view = {.view = {.pose = first.pose, .utility = static_cast<double>(cells.size())}},
                  .way = GridPaths(situation.reachable()).to(first.place)};
  view.view.hoped.assign(half, cells.end());
  cells.erase(half, cells.end());
  view.view.unknown = std::move(cells);
  view.reason = "the first of " + std::to_string(tour.size()) + " views of a tour, a view of " +
                std::to_string(first.sees.size()) + " unknown cells";
  return view;
}

}  // namespace detail

VANTAGE_INLINE TourPlanner::TourPlanner(const PlannerSetup& setup, const TourOptions& options)
    : FrontierPlanner(setup, options.survey), options_(options) {
  detail::tour_settings().validate(options);
}

VANTAGE_INLINE MotionModel TourPlanner::default_motion() {
  return {.max_speed_m_s = 2.0, .max_acceleration_m_s2 = 3.0, .max_yaw_rate_rad_s = 0.5 * std::numbers::pi};
}

VANTAGE_INLINE std::optional<ChosenView> TourPlanner::choose(Plan& plan) {
  const detail::BlockWays ways = detail::ways_through(situation().reachable(), situation().map().frame());
  const std::vector<detail::FrontierSite> sites = detail::nearest_sites(situation(), options_, ways);
  return situation().sensor().looks_all_around() ? detail::first_sight(situation(), sites, options_.cost, ways, plan)
                                                 : detail::first_view(situation(), sites, options_, ways, plan);
}

}  // namespace vantage
