// SPDX-License-Identifier: MIT
#include "evaluation/falcon_like.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace vantage::detail {
namespace {

constexpr double kBlockM = 5.0;
// A path over more zones than these leaves out the furthest.
constexpr std::size_t kMostZones = 40;

Zones zones_of(const Situation& situation) {
  const OccupancyMap& map = situation.map();
  const VoxelBox known = map.bounds().grown(1);
  const VoxelBox box = map.region() ? *map.region() : known;
  return {map.frame(), box, std::max(1, map.frame().cells_up_to(kBlockM)), [&](const VoxelIndex& cell) {
            const Occupancy state = map.at(cell);
            return state == Occupancy::Free      ? ZoneKind::Free
                   : state == Occupancy::Unknown ? ZoneKind::Unknown
                                                 : ZoneKind::None;
          }};
}

}  // namespace

std::vector<std::size_t> coverage_path(const Zones& zones, const std::map<std::size_t, double>& to_cover) {
  std::vector<std::size_t> covered;
  for (const auto& [zone, way_m] : to_cover) {
    if (std::isfinite(way_m)) {
      covered.push_back(zone);
    }
  }
  std::stable_sort(covered.begin(), covered.end(),
                   [&](std::size_t a, std::size_t b) { return to_cover.at(a) < to_cover.at(b); });
  covered.resize(std::min(covered.size(), kMostZones));
  std::map<std::size_t, std::vector<double>> lengths;
  return cheapest_order(covered, Zones::kNone, [&](std::size_t from, std::size_t to) {
    if (from == Zones::kNone) {
      return to_cover.at(to);
    }
    auto known = lengths.find(from);
    if (known == lengths.end()) {
      known = lengths.emplace(from, zones.lengths_from(from)).first;
    }
    return known->second[to];
  });
}

Choice FalconLikePeer::choose(const Situation& situation) {
  const VoxelIndex start = *situation.reachable().start();
  const std::vector<double> from_start = situation.ways().lengths_from(start);
  std::vector<ViewedSite> parts = sites(situation, from_start);
  const Zones zones = zones_of(situation);
  // A part belongs to the zone of its unknown cells, because it may be seen from afar.
  std::map<std::size_t, std::vector<std::size_t>> parts_in;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts_in[zones.zone_of(parts[i].site.middle.unknown)].push_back(i);
  }
  // From here to a zone, the way to the nearest of its parts counts.
  std::map<std::size_t, double> to_cover;
  for (const auto& [zone, numbers] : parts_in) {
    if (zone != Zones::kNone) {
      to_cover[zone] = parts[numbers.front()].way_m;
    }
  }
  // The parts of the first two zones that have some, and the nearest of the next.
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t zone : coverage_path(zones, to_cover)) {
    if (parts_in.contains(zone) && groups.size() < 3) {
      groups.push_back(parts_in.at(zone));
    }
  }
  if (groups.empty()) {  // no way leads to the zone of any part
    groups.push_back({0});
  }
  std::vector<ViewedSite> ahead;
  std::vector<std::vector<std::size_t>> numbers;
  for (const std::vector<std::size_t>& group : groups) {
    numbers.emplace_back();
    for (const std::size_t i : group) {
      numbers.back().push_back(ahead.size());
      ahead.push_back(parts[i]);
    }
  }
  PlanStatistics statistics;
  look_at(situation, ahead, statistics);
  std::vector<TourView> best;
  best.reserve(ahead.size());
  for (const ViewedSite& part : ahead) {
    best.push_back(part.views.front());
  }
  TourLegs costs = legs(situation, from_start, best);
  const LegCost leg = [&](std::size_t from, std::size_t to) { return costs.between(from, to); };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto end = i + 1 < numbers.size() ? std::optional(numbers[i + 1].front()) : std::nullopt;
    const std::vector<std::size_t> within =
        cheapest_order(numbers[i], order.empty() ? best.size() : order.back(), leg, end);
    order.insert(order.end(), within.begin(), within.end());
  }
  return refined(situation, ahead, order, from_start, statistics);
}

}  // namespace vantage::detail
