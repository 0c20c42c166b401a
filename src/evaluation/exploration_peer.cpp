// SPDX-License-Identifier: MIT
#include "evaluation/exploration_peer.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vantage::detail {
namespace {

// Cells that stand for those of a part.
constexpr std::size_t kMostCells = 64;
// A view is kept if it shows this share of what the best one of the part shows.
constexpr double kKept = 0.8;

// The part with some of its targets, evenly chosen.
FrontierSite thinned(const FrontierSite& site) {
  FrontierSite thin{site.middle, {}};
  const std::size_t stride = (site.targets.size() + kMostCells - 1) / kMostCells;
  for (std::size_t i = 0; i < site.targets.size(); i += stride) {
    thin.targets.push_back(site.targets[i]);
  }
  return thin;
}

}  // namespace

std::vector<ViewedSite> ExplorationPeer::sites(const Situation& situation,
                                               const std::vector<double>& from_start) const {
  const VoxelIndex start = *situation.reachable().start();
  std::vector<ViewedSite> all;
  for (FrontierSite& site : frontier_parts(situation, kSiteM)) {
    const double way_m = situation.ways().length_to(site.middle.viewpoint, start, from_start);
    all.push_back({.site = std::move(site), .way_m = way_m, .unknown = {}, .views = {}});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const ViewedSite& a, const ViewedSite& b) { return a.way_m < b.way_m; });
  return all;
}

void ExplorationPeer::sample_views(const Situation& situation, ViewedSite& site, std::size_t most,
                                   PlanStatistics& statistics) const {
  TourViews sampled(situation, {thinned(site.site)}, statistics.ray_operations);
  statistics.views_scored += sampled.views.size();
  site.unknown = std::move(sampled.unknown);
  site.views = std::move(sampled.views);
  std::stable_sort(site.views.begin(), site.views.end(),
                   [](const TourView& a, const TourView& b) { return a.sees.size() > b.sees.size(); });
  if (site.views.empty()) {  // what is left is beyond the resolving range, or seen in part
    const TargetView view = view_of_target(situation.surveyed(), site.site.middle, statistics.ray_operations);
    site.unknown = view.unknown;
    site.views.push_back({site.site.middle.viewpoint, view.view.pose, {}});
    site.views.front().sees.resize(view.unknown.size());
    std::iota(site.views.front().sees.begin(), site.views.front().sees.end(), 0U);
  }
  const double least = kKept * static_cast<double>(site.views.front().sees.size());
  std::erase_if(site.views, [&](const TourView& view) { return static_cast<double>(view.sees.size()) < least; });
  if (site.views.size() > most) {
    site.views.erase(site.views.begin() + static_cast<std::ptrdiff_t>(most), site.views.end());
  }
}

Choice ExplorationPeer::taking(const Situation& situation, const TourView& view,
                               const std::vector<VoxelIndex>& unknown, const PlanStatistics& so_far) {
  std::vector<std::pair<double, VoxelIndex>> ranked;
  for (const std::uint32_t number : view.sees) {
    const Eigen::Vector3d line = situation.map().frame().centre_of(unknown[number]) - view.pose.translation();
    ranked.emplace_back(-line.stableNormalized().dot(optical_axis(view.pose)), unknown[number]);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  TargetView taken{.view = {.pose = view.pose, .utility = static_cast<double>(ranked.size())}};
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    (2 * i < ranked.size() ? taken.unknown : taken.hoped).push_back(ranked[i].second);
  }
  Choice choice{.view = std::move(taken), .way = situation.way_to(view.place), .statistics = so_far};
  if (const std::optional<MotionModel>& motion = situation.setup().motion) {
    if (std::optional<std::vector<Pose>> path = situation.path_to(view.pose, choice.way)) {
      motion_.follow(*path, *motion);
      choice.path = std::move(*path);
    }
  }
  return choice;
}

}  // namespace vantage::detail
