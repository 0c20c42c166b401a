// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vantage/planner/tour_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/planner/impl/block_ways.hpp>
#include <vantage/planner/impl/frontier_sites.hpp>
#include <vantage/planner/impl/open_tour.hpp>
#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/planner/impl/unknown_ways.hpp>

namespace vantage {
namespace detail {

inline constexpr double kAllAroundRad = 2.0 * std::numbers::pi - 1e-3;

// Blocks of about a metre.
inline std::int32_t side_for(double cell_m) { return cell_m < 0.15 ? 8 : 4; }

inline BlockWays ways_through(const ReachableSpace& space, const VoxelFrame& frame) {
  return BlockWays(frame, side_for(frame.size_m), [&space](const VoxelIndex& brick) {
    const BrickPlane* const cells = space.find(brick);
    return cells == nullptr ? BrickPlane{} : *cells;
  });
}

// A site, and the view from beside its middle.
struct Stop {
  FrontierSite site;
  double way_m;  // from the start of the reachable space
  Pose view;

  [[nodiscard]] const VoxelIndex& place() const { return site.middle.viewpoint; }
};

// The nearest sites, nearest first.
inline std::vector<Stop> nearest_stops(const Situation& situation, const TourOptions& options,
                                       std::vector<FrontierSite> sites, const BlockWays& ways,
                                       const std::vector<double>& lengths) {
  const VoxelFrame& frame = situation.map().frame();
  const VoxelIndex start = *situation.reachable().start();
  std::vector<Stop> stops;
  for (FrontierSite& site : sites) {
    const double way_m = ways.length_to(site.middle.viewpoint, start, lengths);
    stops.push_back({std::move(site), way_m, Pose::Identity()});
  }
  std::stable_sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.way_m < b.way_m; });
  stops.erase(stops.begin() + static_cast<std::ptrdiff_t>(std::min(stops.size(), options.most_sites)), stops.end());
  for (Stop& stop : stops) {
    const Eigen::Vector3d position = situation.reachable().position_in(stop.place());
    stop.view = situation.platform().facing(position, frame.centre_of(stop.site.middle.unknown) - position);
  }
  return stops;
}

// What a way between two views costs: metres, or the seconds of the longer of moving and turning.
class LegCost {
 public:
  LegCost(const Situation& situation, TourCost cost)
      : motion_(situation.setup().motion.value_or(TourPlanner::default_motion())),
        is_time_(cost == TourCost::Time),
        turns_(is_time_ && situation.sensor().horizontal_angle_rad() < kAllAroundRad) {}

  [[nodiscard]] double of_way(double way_m) const { return is_time_ ? way_m / motion_.max_speed_m_s : way_m; }
  [[nodiscard]] double between(const Pose& from, const Pose& to, double way_m) const {
    if (!turns_) {
      return of_way(way_m);
    }
    const double turn_rad = std::acos(std::clamp(optical_axis(from).dot(optical_axis(to)), -1.0, 1.0));
    return std::max(of_way(way_m), motion_.turn_time_s(turn_rad));
  }

 private:
  MotionModel motion_;
  bool is_time_;
  bool turns_;
};

// The target of a site that is seen from the nearest place.
inline const FrontierTarget& nearest_target(const FrontierSite& site, const BlockWays& ways, const VoxelIndex& start,
                                            const std::vector<double>& lengths) {
  std::vector<double> way_m;
  for (const FrontierTarget& target : site.targets) {
    way_m.push_back(ways.length_to(target.viewpoint, start, lengths));
  }
  return site.targets[static_cast<std::size_t>(std::min_element(way_m.begin(), way_m.end()) - way_m.begin())];
}

// The whole tour counts, less the price of its first site: what it would cost to come back to it from the unknown.
inline OpenTourProblem problem_of(const Situation& situation, const std::vector<Stop>& stops, const BlockWays& ways,
                                  const LegCost& cost) {
  const std::size_t n = stops.size();
  OpenTourProblem problem;
  std::vector<VoxelIndex> places;
  for (const Stop& stop : stops) {
    places.push_back(stop.place());
  }
  for (const Stop& from : stops) {
    const std::vector<double> lengths = ways.lengths_from(from.place(), places);
    for (const Stop& to : stops) {
      problem.legs.push_back(cost.between(from.view, to.view, ways.length_to(to.place(), from.place(), lengths)));
    }
  }
  for (const Stop& to : stops) {
    problem.legs.push_back(cost.between(situation.current(), to.view, to.way_m));
  }
  const RangeSensor& sensor = situation.sensor();
  const detail::UnknownWays unknown(
      situation.map(), std::min(sensor.max_range_m, sensor.resolving_range_m(situation.map().resolution_m())),
      places);
  for (const Stop& stop : stops) {
    problem.prices.push_back(cost.of_way(unknown.mean_m(stop.place())));
  }
  problem.leg_weights.assign(n, 1.0);
  problem.price_weights.assign(n, 0.0);
  problem.price_weights.front() = -1.0;
  return problem;
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
  const ReachableSpace& reachable = situation().reachable();
  const detail::BlockWays ways = detail::ways_through(reachable, situation().map().frame());
  const std::int32_t site_cells = std::max(1, situation().map().frame().cells_up_to(options_.site_m));
  std::vector<detail::FrontierSite> sites = detail::frontier_sites(situation().survey().targets, site_cells);
  std::vector<VoxelIndex> places;
  for (const detail::FrontierSite& site : sites) {
    places.push_back(site.middle.viewpoint);
  }
  const std::vector<double> lengths = ways.lengths_from(*reachable.start(), places, options_.most_sites);
  const std::vector<detail::Stop> stops =
      detail::nearest_stops(situation(), options_, std::move(sites), ways, lengths);
  plan.statistics.views_scored += stops.size();
  const detail::LegCost cost(situation(), options_.cost);
  const std::size_t first =
      stops.size() == 1 ? 0 : detail::open_tour(detail::problem_of(situation(), stops, ways, cost)).front();
  const FrontierTarget wanted = detail::nearest_target(stops[first].site, ways, *reachable.start(), lengths);
  ChosenView chosen{.view = view_of_target(situation(), wanted, plan.statistics.ray_operations),
                    .way = GridPaths(reachable).to(wanted.viewpoint)};
  // Once the wanted cell is known, the tour is planned again: waiting for all cells in view takes longer ways.
  TargetView& view = chosen.view;
  chosen.reason = "the first of " + std::to_string(stops.size()) + " places of a tour, a view of " +
                  std::to_string(view.unknown.size()) + " unknown cells";
  std::erase(view.unknown, wanted.unknown);
  view.hoped = std::exchange(view.unknown, {wanted.unknown});
  return chosen;
}

}  // namespace vantage
