// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/planner/tour_planner.hpp>
#include <vector>

#include <vantage/geometry/impl/pose_distance.hpp>
#include <vantage/planner/impl/block_ways.hpp>
#include <vantage/planner/impl/tour_views.hpp>

namespace vantage::detail {

/// What a tour from the current pose over views costs: metres, or seconds, for each leg the longer of moving and
/// turning.
class TourLegs {
 public:
  /// `from_start`: the ways from the start of the reachable space, as BlockWays::lengths_from returns them. The other
  /// references must outlive the object.
  TourLegs(const Situation& situation, TourCost cost, const BlockWays& ways, const std::vector<double>& from_start,
           const std::vector<TourView>& views)
      : situation_(situation),
        ways_(ways),
        views_(views),
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
    const std::size_t place = from == views_.size() ? places_.size() : place_of_[from];
    if (ways_m_[place].empty()) {
      ways_m_[place] = ways_to_all(places_[place], ways_.lengths_from(places_[place], places_));
    }
    return of_way(ways_m_[place][place_of_[to]]);
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
  [[nodiscard]] std::vector<double> ways_to_all(const VoxelIndex& from, const std::vector<double>& lengths) const {
    std::vector<double> all(places_.size());
    std::transform(places_.begin(), places_.end(), all.begin(),
                   [&](const VoxelIndex& place) { return ways_.length_to(place, from, lengths); });
    return all;
  }

  const Situation& situation_;
  const BlockWays& ways_;
  const std::vector<TourView>& views_;
  MotionModel motion_;
  bool is_time_;
  bool turns_;
  std::vector<VoxelIndex> places_;           // of the views, without duplicates
  std::vector<std::size_t> place_of_;        // by view: which of the places
  std::vector<std::vector<double>> ways_m_;  // to the places: from each that was asked for, and from the start
};

}  // namespace vantage::detail
