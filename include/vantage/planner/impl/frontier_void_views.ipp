// SPDX-License-Identifier: MIT
#pragma once

// The candidate views of FrontierVoidPlanner (Dornhege & Kleiner 2011, IV-C).
#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/robot/grid_path.hpp>

#include <vantage/geometry/impl/dice.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kProofViews = 50;  // tested before the planner concludes that no view sees a void
inline constexpr double kNearM = 1.0;  // largest extra path length, beyond the nearest viewpoint, of a near one

inline bool sees_all_around(const RangeSensor& sensor) {
  constexpr double kRounding = 1e-6;
  return sensor.horizontal_angle_rad() >= 2.0 * std::numbers::pi - kRounding &&
         sensor.vertical_angle_rad() >= std::numbers::pi - kRounding;
}

// Returns the indices of places by descending value, on demand; ties by index.
class BestPlaces {
 public:
  explicit BestPlaces(std::vector<double> values) : before_{std::move(values)}, heap_(before_.values.size()) {
    std::iota(heap_.begin(), heap_.end(), std::size_t{0});
    std::make_heap(heap_.begin(), heap_.end(), std::cref(before_));
  }
  [[nodiscard]] bool empty() const { return heap_.empty(); }
  std::size_t next() {
    std::pop_heap(heap_.begin(), heap_.end(), std::cref(before_));
    const std::size_t best = heap_.back();
    heap_.pop_back();
    return best;
  }

 private:
  struct Before {
    std::vector<double> values;
    bool operator()(std::size_t a, std::size_t b) const {
      return values[a] != values[b] ? values[a] < values[b] : a > b;
    }
  };
  Before before_;
  std::vector<std::size_t> heap_;
};

// Draws viewing directions for a place.
class DirectionDraw {
 public:
  DirectionDraw(const OccupancyMap& map, const RangeSensor& sensor, const std::vector<FrontierVoid>& voids,
                Dice& dice)
      : map_(map), sensor_(sensor), voids_(voids), dice_(dice) {
    for (const FrontierVoid& one : voids) {
      total_ += one.utility;
      up_to_.push_back(total_);
    }
  }

  // A uniform random direction.
  Eigen::Vector3d anywhere() { return dice_.direction(); }
  // Direction to a frontier cell in clear line of sight and in range, of a void drawn with its utility as weight. A
  // random direction if eight draws find none.
  Eigen::Vector3d at_a_void(const Eigen::Vector3d& place, std::uint64_t& operations) {
    constexpr int kDraws = 8;
    for (int i = 0; i < kDraws; ++i) {
      const auto drawn = std::upper_bound(up_to_.begin(), up_to_.end(), dice_.below(total_));
      const std::vector<VoxelIndex>& frontier = voids_[static_cast<std::size_t>(drawn - up_to_.begin())].frontier;
      const VoxelIndex cell = frontier[dice_.below(frontier.size())];
      Eigen::Vector3d line = map_.frame().centre_of(cell) - place;
      if (line.norm() >= sensor_.min_range_m && line.norm() <= sensor_.max_range_m && line.norm() > 0.0 &&
          in_plain_sight(map_, place, cell, operations)) {
        return line;
      }
    }
    return anywhere();
  }

 private:
  const OccupancyMap& map_;
  const RangeSensor& sensor_;
  const std::vector<FrontierVoid>& voids_;
  Dice& dice_;
  std::vector<std::size_t> up_to_;
  std::size_t total_ = 0;
};

// The targets whose unknown cell belongs to a void.
inline std::vector<const FrontierTarget*> targets_of_voids(const FrontierSurvey& survey, const VoidClusters& voids) {
  std::vector<const FrontierTarget*> targets;
  for (const FrontierTarget& target : survey.targets) {
    if (voids.number_at(target.unknown) != VoidClusters::kNone) {
      targets.push_back(&target);
    }
  }
  return targets;
}

}  // namespace detail

// IV-C: samples orientations at the places in the order of their utility until there are N valid views.
VANTAGE_INLINE std::vector<Pose> FrontierVoidPlanner::sample_views(PlanStatistics& statistics) const {
  const OccupancyMap& map = situation().map();
  const FrontierVoidStrategy& strategy = options_.strategy;
  Dice dice(situation().setup().seed, map.revision());
  detail::DirectionDraw draw(map, situation().sensor(), search_.frontier_voids, dice);
  std::vector<double> values(search_.places.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Eigen::Vector3d line = map.frame().centre_of(search_.places[i]) - situation().current().translation();
    values[i] = discounted(static_cast<double>(search_.utility[i]), line.norm());
  }
  const std::size_t orientations =
      detail::sees_all_around(situation().sensor()) ? 1 : strategy.orientations_per_place;
  std::vector<Pose> views;
  std::vector<Eigen::Vector3d> taken;
  for (detail::BestPlaces best(std::move(values)); !best.empty() && views.size() < options_.views;) {
    const Eigen::Vector3d place = map.frame().centre_of(search_.places[best.next()]);
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const auto& other) { return (place - other).norm() < strategy.place_spacing_m; })) {
      continue;
    }
    taken.push_back(place);
    for (std::size_t i = 0; i < orientations && views.size() < options_.views; ++i) {
      const Eigen::Vector3d direction =
          strategy.aimed ? draw.at_a_void(place, statistics.ray_operations) : draw.anywhere();
      const Pose view = situation().platform().facing(place, direction);
      if (situation().platform().admits(map, view)) {
        views.push_back(view);
      }
    }
  }
  return views;
}

// Views of at most `most` targets, evenly distributed over the list.
VANTAGE_INLINE std::vector<Pose> FrontierVoidPlanner::views_of(const std::vector<const FrontierTarget*>& targets,
                                                               std::size_t most, PlanStatistics& statistics) const {
  std::vector<Pose> views;
  const std::size_t stride = targets.size() / most + 1;
  for (std::size_t i = 0; i < targets.size(); i += stride) {
    const TargetView view = view_of_target(situation(), *targets[i], statistics.ray_operations);
    if (situation().platform().admits(situation().map(), view.view.pose)) {
      views.push_back(view.view.pose);
    }
  }
  return views;
}

// Views of targets at voids. Used if sampling finds no view of a void, to decide whether there is one.
VANTAGE_INLINE std::vector<Pose> FrontierVoidPlanner::views_of_voids(PlanStatistics& statistics) const {
  return views_of(detail::targets_of_voids(situation().survey(), search_.voids),
                  std::min(options_.views, detail::kProofViews), statistics);
}

// Views from the nearest viewpoints of targets at voids.
VANTAGE_INLINE std::vector<Pose> FrontierVoidPlanner::near_views(PlanStatistics& statistics) const {
  const OccupancyMap& map = situation().map();
  const FrontierSurvey& survey = situation().survey();
  if (options_.strategy.near_views == 0) {
    return {};
  }
  const std::vector<const FrontierTarget*> targets = detail::targets_of_voids(survey, search_.voids);
  std::vector<VoxelIndex> viewpoints;
  viewpoints.reserve(targets.size());
  for (const FrontierTarget* target : targets) {
    viewpoints.push_back(target->viewpoint);
  }
  std::vector<const FrontierTarget*> near;
  for (const VoxelIndex& viewpoint :
       GridPaths(situation().reachable()).nearest_within(viewpoints, detail::kNearM, map.resolution_m()).goals) {
    near.push_back(*std::find_if(targets.begin(), targets.end(),
                                 [&](const FrontierTarget* target) { return target->viewpoint == viewpoint; }));
  }
  return views_of(near, options_.strategy.near_views, statistics);
}

}  // namespace vantage
