// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/planner/tour_planner.hpp>
#include <vector>

#include <vantage/geometry/impl/pose_distance.hpp>
#include <vantage/planner/impl/tour_views.hpp>
#include <vantage/robot/impl/block_ways.hpp>

namespace vantage::detail {

/// What a tour from the current pose over views costs: metres, or seconds, for each leg the longer of moving and
/// turning. A robot that moves is sooner where it moves to, and must stop first to go elsewhere.
class TourLegs {
 public:
  /// `velocity_m_s`: that of the sensor. `from_start`: the ways from the start of the reachable space, as
  /// BlockWays::lengths_from returns them. The other references must outlive the object.
  TourLegs(const Situation& situation, TourCost cost, const Eigen::Vector3d& velocity_m_s, const BlockWays& ways,
           const std::vector<double>& from_start, const std::vector<TourView>& views)
      : situation_(situation),
        ways_(ways),
        views_(views),
        velocity_m_s_(velocity_m_s),
        motion_(situation.setup().motion.value_or(TourPlanner::default_motion())),
        is_time_(cost == TourCost::Time),
        turns_(is_time_ && !situation.sensor().looks_all_around()) {
    for (const TourView& view : views) {
      places_.push_back(view.place);
    }
    sort_unique(places_);
    for (const TourView& view : views) {
      const auto at = std::lower_bound(places_.begin(), places_.end(), view.place, RasterOrder{});
      place_of_.push_back(static_cast<std::size_t>(at - places_.begin()));
    }
    ways_m_.resize(places_.size());
    ways_m_.push_back(ways_to_all(*situation.reachable().start(), from_start));
  }

  /// The cost of a way without turning.
  [[nodiscard]] double of_way(double way_m) const { return is_time_ ? way_m / motion_.max_speed_m_s : way_m; }
  /// Braking for a view and speeding up again.
  [[nodiscard]] double of_stop() const {
    return of_way(motion_.max_speed_m_s * motion_.max_speed_m_s / motion_.max_acceleration_m_s2);
  }
  /// From a view, or from the current pose if `from` is the number of views, without turning.
  [[nodiscard]] double moving(std::size_t from, std::size_t to) {
    const double way_m = length_m(from, to);
    return is_time_ && from == views_.size() ? leaving(way_m, to) : of_way(way_m);
  }
  /// The longer of moving and turning.
  [[nodiscard]] double between(std::size_t from, std::size_t to) {
    const double way = moving(from, to);
    if (!turns_) {
      return way;
    }
    const Pose& pose = from == views_.size() ? situation_.current() : views_[from].pose;
    return std::max(way, motion_.turn_time_s(angle_rad(pose, views_[to].pose)));
  }

 private:
  [[nodiscard]] double length_m(std::size_t from, std::size_t to) {
    const std::size_t place = from == views_.size() ? places_.size() : place_of_[from];
    if (ways_m_[place].empty()) {
      ways_m_[place] = ways_to_all(places_[place], ways_.lengths_from(places_[place], places_));
    }
    return ways_m_[place][place_of_[to]];
  }
  // From the motion that the robot is in now. What leads it aside is stopped, and it has to come back.
  [[nodiscard]] double leaving(double way_m, std::size_t to) const {
    if (way_m == BlockWays::kNoWay) {
      return way_m;
    }
    const Eigen::Vector3d straight =
        situation_.reachable().position_in(views_[to].place) - situation_.current().translation();
    const double along_m_s = straight.stableNormalized().dot(velocity_m_s_);
    const double aside_m_s = std::sqrt(std::max(0.0, velocity_m_s_.squaredNorm() - along_m_s * along_m_s));
    const double saved_s = motion_.travel_time_s(way_m) - motion_.travel_time_s(way_m, along_m_s);
    return std::max(of_way(way_m) - saved_s, motion_.travel_time_s(0.0, aside_m_s));
  }
  [[nodiscard]] std::vector<double> ways_to_all(const VoxelIndex& from, const std::vector<double>& lengths) const {
    std::vector<double> all(places_.size());
    std::transform(places_.begin(), places_.end(), all.begin(),
                   [&](const VoxelIndex& place) { return ways_.length_to(place, from, lengths); });
    return all;
  }

  const Situation& situation_;
  const BlockWays& ways_;
  const std::vector<TourView>& views_;
  Eigen::Vector3d velocity_m_s_;
  MotionModel motion_;
  bool is_time_;
  bool turns_;
  std::vector<VoxelIndex> places_;           // of the views, without duplicates
  std::vector<std::size_t> place_of_;        // by view: which of the places
  std::vector<std::vector<double>> ways_m_;  // to the places: from each that was asked for, and from the start
};

}  // namespace vantage::detail
