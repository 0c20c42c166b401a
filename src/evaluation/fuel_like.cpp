// SPDX-License-Identifier: MIT
#include "evaluation/fuel_like.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include <vantage/view/impl/open_tour.hpp>

namespace vantage::detail {
namespace {

// Parts whose views are sampled.
constexpr std::size_t kSampled = 24;
// Views of a part, and the parts of a tour, among which the first is chosen: those within this distance.
constexpr std::size_t kViews = 15;
constexpr std::size_t kRefined = 7;
constexpr double kRefinedM = 5.0;
// A leg so long that the cheapest tour has it only where it must: longer than all others together.
constexpr double kForbidden = 1e7;

}  // namespace

std::vector<std::size_t> cheapest_order(const std::vector<std::size_t>& views, std::size_t start, const LegCost& leg,
                                        std::optional<std::size_t> end) {
  std::vector<std::size_t> sites = views;
  if (end) {
    sites.push_back(*end);  // the legs that leave it are forbidden, so it is the last
  }
  OpenTourProblem problem;
  problem.shows.assign(sites.size(), 0.0);  // the length alone counts
  for (std::size_t from = 0; from <= sites.size(); ++from) {
    const bool leaves_end = end && from + 1 == sites.size();
    for (std::size_t to = 0; to < sites.size(); ++to) {
      const double cost = leaves_end ? kForbidden : leg(from < sites.size() ? sites[from] : start, sites[to]);
      problem.legs.push_back(std::min(cost, kForbidden));
    }
  }
  std::vector<std::size_t> order;
  for (const std::size_t site : sites.empty() ? std::vector<std::size_t>{} : open_tour(problem)) {
    if (site < views.size()) {
      order.push_back(views[site]);
    }
  }
  return order;
}

void RefiningPeer::look_at(const Situation& situation, std::vector<ViewedSite>& parts,
                           PlanStatistics& statistics) const {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    ViewedSite& part = parts[i];
    if (i < kSampled) {
      sample_views(situation, part, kViews, statistics);
    } else {
      const FrontierTarget& middle = part.site.middle;
      const Eigen::Vector3d from = situation.reachable().position_in(middle.viewpoint);
      part.unknown = {middle.unknown};
      part.views = {{middle.viewpoint,
                     situation.platform().facing(from, situation.map().frame().centre_of(middle.unknown) - from),
                     {0}}};
    }
  }
}

Choice RefiningPeer::refined(const Situation& situation, const std::vector<ViewedSite>& parts,
                             const std::vector<std::size_t>& order, const std::vector<double>& from_start,
                             const PlanStatistics& so_far) {
  std::vector<TourView> views;
  std::vector<std::vector<std::size_t>> layers;
  std::optional<std::size_t> end;
  for (std::size_t i = 0; i < order.size() && !end; ++i) {
    const ViewedSite& part = parts[order[i]];
    const bool is_near =
        (part.views.front().pose.translation() - situation.current().translation()).norm() <= kRefinedM;
    if (i == 0 || (i < kRefined && is_near)) {
      layers.emplace_back(part.views.size());
      std::iota(layers.back().begin(), layers.back().end(), views.size());
      views.insert(views.end(), part.views.begin(), part.views.end());
    } else {
      end = views.size();
      views.push_back(part.views.front());
    }
  }
  TourLegs costs = legs(situation, from_start, views);
  const std::size_t first = cheapest_through(
      layers, views.size(), [&](std::size_t from, std::size_t to) { return costs.between(from, to); }, end)[0];
  Choice choice = taking(situation, views[first], parts[order.front()].unknown, so_far);
  choice.reason = "the first of " + std::to_string(order.size()) + " parts of a tour, a view of " +
                  std::to_string(views[first].sees.size()) + " unknown cells";
  return choice;
}

Choice FuelLikePeer::choose(const Situation& situation) {
  const std::vector<double> from_start = situation.ways().lengths_from(*situation.reachable().start());
  std::vector<ViewedSite> parts = sites(situation, from_start);
  PlanStatistics statistics;
  look_at(situation, parts, statistics);
  std::vector<TourView> best;
  best.reserve(parts.size());
  for (const ViewedSite& part : parts) {
    best.push_back(part.views.front());
  }
  std::vector<std::size_t> all(parts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  TourLegs costs = legs(situation, from_start, best);
  const std::vector<std::size_t> order =
      cheapest_order(all, best.size(), [&](std::size_t from, std::size_t to) { return costs.between(from, to); });
  return refined(situation, parts, order, from_start, statistics);
}

}  // namespace vantage::detail
