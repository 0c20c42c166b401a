// SPDX-License-Identifier: MIT
#include "evaluation/tare_like.hpp"

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vantage/geometry/raster_order.hpp>

#include <vantage/view/impl/cover_tour.hpp>
#include "evaluation/fuel_like.hpp"

namespace vantage::detail {
namespace {

constexpr double kHorizonM = 10.0;
constexpr double kCubeM = 6.0;
// The nearest parts that are covered, and the views of a cover.
constexpr std::size_t kMostNear = 24;

}  // namespace

std::vector<std::size_t> coarse_places(const std::vector<ViewedSite>& parts, double horizon_m, double cube_m,
                                       const VoxelFrame& frame) {
  std::vector<std::size_t> places;
  std::set<VoxelIndex, RasterOrder> cubes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Eigen::Vector3d at = frame.centre_of(parts[i].site.middle.viewpoint) / cube_m;
    const VoxelIndex cube{static_cast<std::int32_t>(std::floor(at.x())),
                          static_cast<std::int32_t>(std::floor(at.y())),
                          static_cast<std::int32_t>(std::floor(at.z()))};
    if (parts[i].way_m > horizon_m && cubes.insert(cube).second) {
      places.push_back(i);
    }
  }
  return places;
}

Choice TareLikePeer::choose(const Situation& situation) {
  const std::vector<double> from_start = situation.ways().lengths_from(*situation.reachable().start());
  const std::vector<ViewedSite> parts = sites(situation, from_start);
  std::vector<FrontierSite> near;
  for (std::size_t i = 0; i < parts.size() && parts[i].way_m <= kHorizonM && near.size() < kMostNear; ++i) {
    near.push_back(parts[i].site);
  }
  PlanStatistics statistics;
  const TourViews close(situation, near, statistics.ray_operations);
  statistics.views_scored += close.views.size();
  std::vector<TourView> views = close.views;
  std::vector<std::size_t> coarse;
  for (const std::size_t i : coarse_places(parts, kHorizonM, kCubeM, situation.map().frame())) {
    coarse.push_back(views.size());
    views.push_back({parts[i].site.middle.viewpoint, situation.current(), {}});
  }
  TourLegs costs = legs(situation, from_start, views);
  const LegCost leg = [&](std::size_t from, std::size_t to) { return costs.between(from, to); };
  // Beyond, turning does not count.
  const std::vector<std::size_t> beyond =
      cheapest_order(coarse, views.size(), [&](std::size_t from, std::size_t to) { return costs.moving(from, to); });
  const std::size_t here = views.size();
  CoverTourProblem problem;
  problem.per_view = costs.of_stop();
  problem.leg = [&](std::size_t from, std::size_t to) { return leg(from == close.views.size() ? here : from, to); };
  for (const TourView& view : close.views) {
    problem.sees.push_back(view.sees);
  }
  const std::vector<std::size_t> cover = cover_tour(problem, kMostNear);
  const auto end = beyond.empty() ? std::nullopt : std::optional(beyond.front());
  const std::vector<std::size_t> tour = cheapest_order(cover, here, leg, end);
  if (!tour.empty()) {
    Choice choice = taking(situation, views[tour.front()], close.unknown, statistics);
    choice.reason = "the first of " + std::to_string(tour.size()) + " views near here, before " +
                    std::to_string(beyond.size()) + " places beyond";
    return choice;
  }
  for (const ViewedSite& part : parts) {
    if (!beyond.empty() && part.site.middle.viewpoint == views[beyond.front()].place) {
      ViewedSite seen = part;
      sample_views(situation, seen, 1, statistics);
      return taking(situation, seen.views.front(), seen.unknown, statistics);
    }
  }
  return nearest_view(situation, statistics);
}

}  // namespace vantage::detail
