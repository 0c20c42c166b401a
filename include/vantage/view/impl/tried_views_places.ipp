// SPDX-License-Identifier: MIT
#pragma once

// Places that could not be reached.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/view/tried_views.hpp>

#include <vantage/geometry/impl/pose_distance.hpp>
#include <vantage/view/impl/cell_distance.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kMostPlaces = 4096;
inline constexpr int kMostFailures = 3;
inline constexpr int kMostAsks = 2;            // for a goal to which the robot comes no nearer
inline constexpr std::size_t kStuckGoals = 3;  // to none of which the robot comes nearer
inline constexpr std::size_t kStuckGoalsOnOneSide = 24;
inline constexpr int kStuckFailures = 150;      // reported, from one place
inline constexpr std::uint64_t kFirstRest = 8;  // plans
inline constexpr double kNearer = 0.01;         // metres or radians; smaller progress is ignored as jitter

// Whether there is more than jitter between two poses.
inline bool is_more_than_jitter(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm() > kNearer || angle_rad(a, b) > kNearer;
}

// Whether all directions lie in one half of the compass.
inline bool lie_on_one_side(const std::vector<Eigen::Vector3d>& directions) {
  std::vector<double> headings_rad;
  headings_rad.reserve(directions.size());
  for (const Eigen::Vector3d& direction : directions) {
    headings_rad.push_back(std::atan2(direction.y(), direction.x()));
  }
  std::sort(headings_rad.begin(), headings_rad.end());
  double widest_rad = headings_rad.front() + 2.0 * std::numbers::pi - headings_rad.back();
  for (std::size_t i = 1; i < headings_rad.size(); ++i) {
    widest_rad = std::max(widest_rad, headings_rad[i] - headings_rad[i - 1]);
  }
  return widest_rad >= std::numbers::pi;
}

}  // namespace detail

VANTAGE_INLINE double TriedViews::tolerance_m() const { return std::max(options_.goal_tolerance_m, cell_m_); }

// What is left of a path, as one number that shrinks while a robot follows it: within the tolerance the angle that is
// left, which is at most pi, and before that pi plus the metres that are left.
VANTAGE_INLINE double TriedViews::way_to_go(const std::vector<Pose>& path) const {
  const double length_m = detail::length_m(path);
  return length_m > tolerance_m() ? std::numbers::pi + length_m : detail::angle_rad(path.front(), path.back());
}

VANTAGE_INLINE bool TriedViews::expect(const OccupancyMap& map, const std::vector<Pose>& path,
                                       std::vector<VoxelIndex> sought, std::vector<VoxelIndex> hoped) {
  Place& place = place_of(map.frame().cell_of(path.back().translation()));
  if (place.revision != map.revision()) {  // else this map was already planned in
    const double way = way_to_go(path);
    const bool first = place.revision == 0;
    const bool moved = !place.asked_from || detail::is_more_than_jitter(path.front(), *place.asked_from);
    place.revision = map.revision();
    place.asked_from = path.front();
    if (first || (moved && way < place.nearest_way - detail::kNearer)) {
      place.failures = first ? place.failures : std::min(place.failures, 1);
      place.nearest_way = way;
      place.no_nearer = 0;
    } else if (++place.no_nearer == detail::kMostAsks) {
      fail(place);
      rest_now();
      expected_.reset();
      return false;
    }
  }
  const bool of_contested = !sought.empty() && map.contested(sought.front());
  expected_ = Expectation{path.back(), map.revision(), std::move(sought), std::move(hoped), of_contested};
  return true;
}

VANTAGE_INLINE TriedViews::Place& TriedViews::place_of(const VoxelIndex& cell) {
  const auto found = std::find_if(places_.begin(), places_.end(), [&](const Place& one) { return one.cell == cell; });
  if (found != places_.end()) {
    return *found;
  }
  if (places_.size() == detail::kMostPlaces) {
    const auto dispensable =
        std::find_if(places_.begin(), places_.end(), [](const Place& one) { return one.failures == 0; });
    places_.erase(dispensable == places_.end() ? places_.begin() : dispensable);
  }
  return places_.emplace_back(Place{.cell = cell});
}

// A host that reports may refuse hundreds of places. They rest so long that all are tried before any is tried again.
VANTAGE_INLINE void TriedViews::fail(Place& place) {
  const bool silent = place.no_nearer > 0;
  const int shift = silent ? std::min(place.failures, 8) : 3 * std::min(place.failures, 3);
  ++place.failures;
  place.rests_until = plans_ + (detail::kFirstRest << shift);
}

VANTAGE_INLINE void TriedViews::no_way_to(const VoxelIndex& cell) {
  Place& place = place_of(cell);
  place.no_nearer = detail::kMostAsks;
  place.asked_from.reset();
  fail(place);
  rest_now();
}

VANTAGE_INLINE bool TriedViews::given_up(const Place& place) const {
  return place.rests_until > plans_ &&
         (place.failures >= detail::kMostFailures || place.no_nearer >= detail::kMostAsks);
}

// After its rest, a place is asked for as if for the first time.
VANTAGE_INLINE void TriedViews::rest_now() {
  std::vector<VoxelIndex> resting;
  for (Place& place : places_) {
    if (place.rests_until > plans_) {
      resting.push_back(place.cell);
    } else if (std::exchange(place.rests_until, 0) > 0) {
      place.no_nearer = 0;
      place.revision = 0;
    }
  }
  std::sort(resting.begin(), resting.end(), RasterOrder{});
  if (resting == resting_) {
    return;
  }
  resting_ = std::move(resting);
  rest_blocks_.clear();
  for (const VoxelIndex& goal : resting_) {
    const VoxelBox near = box_of_rest(goal);
    for_each_cell({rest_block(near.lo), rest_block(near.hi - VoxelIndex{1, 1, 1}) + VoxelIndex{1, 1, 1}},
                  [&](const VoxelIndex& block) { rest_blocks_[block].push_back(goal); });
  }
}

VANTAGE_INLINE bool TriedViews::try_resting_again() {
  bool any = false;
  for (Place& place : places_) {
    if (place.rests_until > plans_ && !given_up(place)) {
      place.rests_until = 0;
      any = true;
    }
  }
  rest_now();
  return any;
}

VANTAGE_INLINE void TriedViews::end_run() {
  for (Place& place : places_) {
    place.rests_until = std::min(place.rests_until, plans_ + detail::kFirstRest);
  }
}

VANTAGE_INLINE std::size_t TriedViews::places_given_up() const {
  return static_cast<std::size_t>(
      std::count_if(places_.begin(), places_.end(), [&](const Place& place) { return given_up(place); }));
}

// By way_to_go, more than pi is further away than the tolerance.
VANTAGE_INLINE std::vector<const TriedViews::Place*> TriedViews::failed_from(const Pose& current) const {
  std::vector<const Place*> failed;
  for (const Place& place : places_) {
    if (place.failures > 0 && place.nearest_way > std::numbers::pi && place.asked_from &&
        (place.asked_from->translation() - current.translation()).norm() <= 0.5 * tolerance_m()) {
      failed.push_back(&place);
    }
  }
  return failed;
}

VANTAGE_INLINE Eigen::Vector3d TriedViews::direction_of(const Place& place, const Pose& current) const {
  return (VoxelFrame{cell_m_}.centre_of(place.cell) - current.translation()).normalized();
}

VANTAGE_INLINE std::vector<Eigen::Vector3d> TriedViews::refused_directions(const Pose& current) const {
  std::vector<Eigen::Vector3d> directions;
  for (const Place* place : failed_from(current)) {
    if (place->rests_until > plans_) {
      directions.push_back(direction_of(*place, current));
    }
  }
  return directions.size() < detail::kStuckGoals ? std::vector<Eigen::Vector3d>() : directions;
}

VANTAGE_INLINE bool TriedViews::is_stuck(const Pose& current) const {
  std::size_t silent = 0;
  int failures = 0;
  std::vector<Eigen::Vector3d> directions;
  for (const Place* place : failed_from(current)) {
    silent += place->rests_until > plans_ && place->no_nearer >= detail::kMostAsks ? 1U : 0U;
    failures += place->failures;
    directions.push_back(direction_of(*place, current));
  }
  if (silent < detail::kStuckGoals && failures < detail::kStuckFailures) {
    return false;
  }
  const bool one_side = detail::lie_on_one_side(directions);
  return silent >= (one_side ? detail::kStuckGoalsOnOneSide : detail::kStuckGoals) ||
         (failures >= detail::kStuckFailures && !one_side && !refused_directions(current).empty());
}

// In cells.
VANTAGE_INLINE double TriedViews::rest_reach() const {
  return std::clamp(options_.goal_tolerance_m / cell_m_, 1.0, 1e6);
}

VANTAGE_INLINE VoxelBox TriedViews::box_of_rest(const VoxelIndex& goal) const {
  return VoxelBox{goal, goal + VoxelIndex{1, 1, 1}}.grown(static_cast<std::int32_t>(rest_reach()));
}

// Blocks are as long as such a box or longer, so that it touches eight at most.
VANTAGE_INLINE VoxelIndex TriedViews::rest_block(const VoxelIndex& cell) const {
  const auto bits = static_cast<int>(std::bit_width(2 * static_cast<std::uint32_t>(rest_reach())));
  return {cell.x >> bits, cell.y >> bits, cell.z >> bits};
}

VANTAGE_INLINE std::vector<VoxelBox> TriedViews::resting() const {
  std::vector<VoxelBox> boxes;
  boxes.reserve(resting_.size());
  for (const VoxelIndex& goal : resting_) {
    boxes.push_back(box_of_rest(goal));
  }
  return boxes;
}

VANTAGE_INLINE bool TriedViews::rests(const VoxelIndex& place) const {
  if (resting_.empty()) {
    return false;
  }
  const double reach = rest_reach();
  const auto block = rest_blocks_.find(rest_block(place));
  return block != rest_blocks_.end() &&
         std::any_of(block->second.begin(), block->second.end(), [&](const VoxelIndex& other) {
           return detail::squared_distance(place, other) <= reach * reach;
         });
}

}  // namespace vantage
