// SPDX-License-Identifier: MIT
#include "evaluation/distance_advantage.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace vantage::detail {

std::vector<double> distance_advantages(const BlockWays& ways, const VoxelIndex& start,
                                        const std::vector<VoxelIndex>& places) {
  std::vector<double> advantages;
  for (const VoxelIndex& place : places) {
    const std::vector<double> lengths = ways.lengths_from(place);
    double sum_m = 0.0;
    double cells = 0.0;
    for (std::size_t piece = 0; piece < lengths.size(); ++piece) {
      if (lengths[piece] != BlockWays::kNoWay) {
        double count = 0.0;
        for (const std::uint64_t word : ways.cells_of(static_cast<BlockWays::Piece>(piece))) {
          count += std::popcount(word);
        }
        sum_m += count * lengths[piece];
        cells += count;
      }
    }
    advantages.push_back(sum_m / cells - ways.length_to(start, place, lengths));
  }
  return advantages;
}

Choice DistanceAdvantagePeer::choose(const Situation& situation) {
  const BlockWays& through = situation.ways();
  const VoxelIndex start = *situation.reachable().start();
  const std::vector<ViewedSite> parts = sites(situation, through.lengths_from(start));
  std::vector<VoxelIndex> places;
  places.reserve(parts.size());
  for (const ViewedSite& part : parts) {
    places.push_back(part.site.middle.viewpoint);
  }
  const std::vector<double> advantages = distance_advantages(through, start, places);
  const auto best = std::max_element(advantages.begin(), advantages.end()) - advantages.begin();
  const FrontierTarget& wanted = parts[static_cast<std::size_t>(best)].site.middle;
  Choice choice{.way = situation.way_to(wanted.viewpoint), .statistics = {.views_scored = places.size()}};
  TargetView view = view_of_target(situation.surveyed(), wanted, choice.statistics.ray_operations);
  // Once the wanted cell is known, the planner chooses again.
  std::erase(view.unknown, wanted.unknown);
  view.hoped = std::exchange(view.unknown, {wanted.unknown});
  choice.view = std::move(view);
  return choice;
}

}  // namespace vantage::detail
