// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <numbers>
#include <queue>
#include <utility>
#include <vantage/view/void_views.hpp>

#include <vantage/geometry/impl/dice.hpp>

namespace vantage {
namespace detail {

inline bool sees_all_around(const RangeSensor& sensor) {
  constexpr double kRounding = 1e-6;
  return sensor.horizontal_angle_rad() >= 2.0 * std::numbers::pi - kRounding &&
         sensor.vertical_angle_rad() >= std::numbers::pi - kRounding;
}

// Draws directions to frontier cells of voids.
class DirectionDraw {
 public:
  DirectionDraw(const SurveyedMap& surveyed, std::span<const FrontierVoid> voids, Dice& dice)
      : surveyed_(surveyed), voids_(voids), dice_(dice) {
    for (const FrontierVoid& one : voids) {
      total_ += one.utility;
      up_to_.push_back(total_);
    }
  }

  // Direction to a frontier cell in clear line of sight and in range, of a void drawn with its utility as weight. A
  // random direction if eight draws find none.
  Eigen::Vector3d at_a_void(const Eigen::Vector3d& place, std::uint64_t& operations) {
    constexpr int kDraws = 8;
    for (int i = 0; i < kDraws; ++i) {
      const auto drawn = std::upper_bound(up_to_.begin(), up_to_.end(), dice_.below(total_));
      const std::vector<VoxelIndex>& frontier = voids_[static_cast<std::size_t>(drawn - up_to_.begin())].frontier;
      const VoxelIndex cell = frontier[dice_.below(frontier.size())];
      Eigen::Vector3d line = surveyed_.map.frame().centre_of(cell) - place;
      const double range_m = line.norm();
      if (range_m >= surveyed_.sensor.min_range_m && range_m <= surveyed_.sensor.max_range_m && range_m > 0.0 &&
          in_plain_sight(surveyed_.map, place, cell, operations)) {
        return line;
      }
    }
    return dice_.direction();
  }

 private:
  const SurveyedMap& surveyed_;
  std::span<const FrontierVoid> voids_;
  Dice& dice_;
  std::vector<std::size_t> up_to_;
  std::size_t total_ = 0;
};

}  // namespace detail

VANTAGE_INLINE VoidViews::VoidViews(const SurveyedMap& surveyed, const VoidClusters& voids, std::uint64_t& operations)
    : surveyed_(surveyed), operations_(operations) {
  std::copy_if(surveyed.survey.targets.begin(), surveyed.survey.targets.end(), std::back_inserter(targets_),
               [&](const FrontierTarget& target) { return voids.number_at(target.unknown) != VoidClusters::kNone; });
}

VANTAGE_INLINE std::vector<Pose> VoidViews::draw(std::span<const VoxelIndex> places, std::span<const double> values,
                                                 std::span<const FrontierVoid> voids, const VoidSampling& sampling,
                                                 std::size_t count, std::uint64_t seed) const {
  detail::Dice dice(seed, surveyed_.map.revision());
  detail::DirectionDraw directions(surveyed_, voids, dice);
  const std::size_t orientations = detail::sees_all_around(surveyed_.sensor) ? 1 : sampling.orientations_per_place;
  // By descending value, ties by index. Few of them are taken, so they are not sorted.
  std::vector<std::pair<double, std::ptrdiff_t>> ranked;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ranked.emplace_back(values[i], -static_cast<std::ptrdiff_t>(i));
  }
  std::priority_queue left(std::less<>(), std::move(ranked));
  std::vector<Pose> views;
  for (std::vector<Eigen::Vector3d> taken; !left.empty() && views.size() < count; left.pop()) {
    const Eigen::Vector3d place =
        surveyed_.map.frame().centre_of(places[static_cast<std::size_t>(-left.top().second)]);
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const auto& other) { return (place - other).norm() < sampling.place_spacing_m; })) {
      continue;
    }
    taken.push_back(place);
    for (std::size_t i = 0; i < orientations && views.size() < count; ++i) {
      const Pose view = surveyed_.platform.facing(
          place, sampling.aimed ? directions.at_a_void(place, operations_) : dice.direction());
      if (surveyed_.platform.admits(surveyed_.map, view)) {
        views.push_back(view);
      }
    }
  }
  return views;
}

VANTAGE_INLINE std::vector<Pose> VoidViews::of_targets(std::size_t most) const {
  std::vector<Pose> views;
  for (std::size_t i = 0; i < targets_.size(); i += targets_.size() / most + 1) {
    const TargetView view = view_of_target(surveyed_, targets_[i], operations_);
    if (surveyed_.platform.admits(surveyed_.map, view.view.pose)) {
      views.push_back(view.view.pose);
    }
  }
  return views;
}

}  // namespace vantage
