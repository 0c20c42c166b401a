// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/view/tried_views.hpp>

#include <vantage/geometry/impl/pose_distance.hpp>
#include <vantage/settings/impl/option_rule.hpp>
#include <vantage/view/impl/cell_distance.hpp>
#include <vantage/view/impl/clear_line.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kMostCells = std::size_t{1} << 18;
inline constexpr std::size_t kMostScans = 64;

inline int known_around(const OccupancyMap& map, const VoxelIndex& cell) {
  return static_cast<int>(std::count_if(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
    return map.at(cell + step) != Occupancy::Unknown;
  }));
}

// Whether two places differ as seen from `unknown`: distance above half of the shorter distance to it.
inline bool differ(const VoxelIndex& unknown, const VoxelIndex& a, const VoxelIndex& b) {
  const double nearer = std::min(squared_distance(unknown, a), squared_distance(unknown, b));
  return squared_distance(a, b) > 0.25 * nearer;
}

// Returns whether it was added.
inline bool add_if_it_differs(const VoxelIndex& unknown, const VoxelIndex& place, std::vector<VoxelIndex>& places) {
  const bool differs = std::all_of(places.begin(), places.end(),
                                   [&](const VoxelIndex& other) { return differ(unknown, place, other); });
  if (differs) {
    places.push_back(place);
  }
  return differs;
}

inline void add_once(const VoxelIndex& place, std::vector<VoxelIndex>& places) {
  if (std::find(places.begin(), places.end(), place) == places.end()) {
    places.push_back(place);
  }
}

inline bool touch(const VoxelIndex& a, const VoxelIndex& b) {
  return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1 && std::abs(a.z - b.z) <= 1;
}

inline bool is_clear_from(const OccupancyMap& map, const VoxelIndex& place, const VoxelIndex& unknown) {
  return is_clear_line(map, map.frame().centre_of(place), unknown);
}

}  // namespace detail

VANTAGE_INLINE TriedViews::TriedViews(const RangeSensor& sensor, const TriedViewsOptions& options)
    : sensor_(sensor), options_(options) {
  detail::require_option(std::isfinite(options.goal_tolerance_m) && options.goal_tolerance_m >= 0.0,
                         "PlannerSetup::goal_tolerance_m", options.goal_tolerance_m, ">= 0");
  detail::require_option(std::isfinite(options.goal_tolerance_rad) && options.goal_tolerance_rad >= 0.0,
                         "PlannerSetup::goal_tolerance_rad", options.goal_tolerance_rad, ">= 0");
  detail::require_option(options.patience >= 1, "patience", options.patience, ">= 1");
}

VANTAGE_INLINE bool TriedViews::review(const OccupancyMap& map, const Pose& current) {
  const bool same_map = map_.is_copied_from(map) && map.revision() >= reviewed_;
  if (same_map && reviewed_ == map.revision()) {
    if (expected_ && reported_ == GoalResult::Failed) {  // a failure is known without a new scan
      ++plans_;
      evaluate(map, current);
      reported_.reset();
      rest_now();
    }
    return false;
  }
  if (!same_map) {
    *this = TriedViews(sensor_, options_);
    cell_m_ = map.resolution_m();
  }
  map_ = KnownMap(map);
  reviewed_ = map.revision();
  ++plans_;
  forget(map);
  if (expected_) {
    evaluate(map, current);
  }
  reported_.reset();
  rest_now();
  remember_scan(current);
  return same_map;
}

VANTAGE_INLINE void TriedViews::remember_scan(const Pose& pose) {
  if (scanned_from_.size() == detail::kMostScans) {
    scanned_from_.pop_front();
  }
  scanned_from_.push_back(pose);
}

// Deletes evidence by the number of known neighbours, not by their states: a surface may change between free and
// occupied forever, while known cells stay known (unless the host makes the map forget).
VANTAGE_INLINE void TriedViews::forget(const OccupancyMap& map) {
  const bool crowded = looks_.size() > detail::kMostCells;
  std::vector<std::uint64_t> ages;
  if (crowded) {
    for (const auto& entry : looks_) {
      ages.push_back(entry.second.latest);
    }
    std::nth_element(ages.begin(), ages.begin() + static_cast<std::ptrdiff_t>(ages.size() / 2), ages.end());
  }
  const std::uint64_t oldest = crowded ? ages[ages.size() / 2] : 0;
  std::erase_if(looks_, [&](const auto& entry) {
    const auto& [cell, looks] = entry;
    return looks.latest < oldest || (map.at(cell) != Occupancy::Unknown && looks.contested.empty()) ||
           detail::known_around(map, cell) > looks.known_neighbours;
  });
  may_hold_.clear();
  for (const auto& entry : looks_) {
    may_hold_.insert(entry.first);
  }
}

VANTAGE_INLINE bool TriedViews::arrived(const Pose& current) const {
  return (expected_->goal.translation() - current.translation()).norm() <= tolerance_m() &&
         detail::angle_rad(expected_->goal, current) <= options_.goal_tolerance_rad;
}

// Evaluates what became of the last planned view.
VANTAGE_INLINE void TriedViews::evaluate(const OccupancyMap& map, const Pose& current) {
  const VoxelIndex goal = map.frame().cell_of(expected_->goal.translation());
  const std::vector<VoxelIndex>& sought = expected_->sought;
  const auto is_unknown = [&](const VoxelIndex& cell) { return map.at(cell) == Occupancy::Unknown; };
  const bool served = !sought.empty() && std::none_of(sought.begin(), sought.end(), [&](const VoxelIndex& cell) {
    return expected_->of_contested ? map.contested(cell) : is_unknown(cell);
  });
  if (served) {
    std::erase_if(places_, [](const Place& place) { return place.failures == 0; });
  }
  if (reported_ == GoalResult::Preempted) {
    std::erase_if(places_, [&](const Place& place) { return place.cell == goal && place.failures == 0; });
  } else if (reported_ == GoalResult::Failed) {
    Place& place = place_of(goal);
    place.no_nearer = 0;
    fail(place);
  } else if (reported_ == GoalResult::Reached || arrived(current)) {
    const double off_m = (expected_->goal.translation() - current.translation()).norm();
    if (reported_ == GoalResult::Reached || off_m < 0.5 * cell_m_) {
      std::erase_if(places_, [&](const Place& place) { return place.cell == goal; });
    } else if (!served) {
      place_of(goal).nearest_way = 0.0;  // it stops off the cell, and comes no nearer than this
    }
    const VoxelIndex here = map.frame().cell_of(current.translation());
    const auto look = [&](const VoxelIndex& cell, std::vector<VoxelIndex> Looks::*unseen) {
      if (!is_unknown(cell)) {
        return;
      }
      Looks& looks = new_look_at(map, cell);
      const bool looked = was_in_view(map, current, cell);
      const bool differs = looked && detail::add_if_it_differs(cell, here, looks.in_vain);
      const bool is_clear_look =
          looked && detail::is_clear_line(map, current.translation(), cell) && add_clear_look(map, looks, cell, here);
      // The robot comes no nearer to the goal than this.
      if (!(differs || is_clear_look) || detail::differ(cell, here, goal)) {
        detail::add_once(goal, looks.*unseen);
      }
    };
    for (const VoxelIndex& cell : sought) {
      if (expected_->of_contested) {
        Looks& looks = new_look_at(map, cell);
        detail::add_once(here, looks.contested);
        detail::add_once(goal, looks.contested);
      } else {
        look(cell, &Looks::missed);
      }
    }
    const std::vector<VoxelIndex>& hoped = expected_->hoped;
    if (std::all_of(hoped.begin(), hoped.end(), is_unknown)) {
      for (const VoxelIndex& cell : hoped) {
        look(cell, &Looks::hoped);
      }
    }
  } else if (!served) {
    return;  // still on the way
  }
  expected_.reset();
}

// The scan may have added a surface in front of the cell, so cells that touch it are not tested.
VANTAGE_INLINE bool TriedViews::was_in_view(const OccupancyMap& map, const Pose& pose,
                                            const VoxelIndex& unknown) const {
  const Eigen::Vector3d line = map.frame().centre_of(unknown) - pose.translation();
  const double range_m = line.norm();
  return range_m >= sensor_.min_range_m && range_m <= sensor_.max_range_m &&
         sensor_.in_view(pose.linear().transpose() * line) &&
         VoxelRay(map.frame(), pose.translation(), map.frame().centre_of(unknown))
             .all_touched([&](const VoxelIndex& cell) {
               return detail::touch(cell, unknown) || map.at(cell) == Occupancy::Free;
             });
}

// Returns whether the look is one from a new place. Looks from beside it whose lines are clear no more count as
// missed: so a cell that changes back and forth does not ask for looks without end.
VANTAGE_INLINE bool TriedViews::add_clear_look(const OccupancyMap& map, Looks& looks, const VoxelIndex& unknown,
                                               const VoxelIndex& place) const {
  std::erase_if(looks.clear, [&](const VoxelIndex& other) {
    const bool is_replaced =
        other != place && detail::touch(place, other) && !detail::is_clear_from(map, other, unknown);
    if (is_replaced) {
      detail::add_once(other, looks.missed);
    }
    return is_replaced;
  });
  const bool is_new = looks.clear.size() < 4 * static_cast<std::size_t>(options_.patience) &&
                      std::none_of(looks.clear.begin(), looks.clear.end(),
                                   [&](const VoxelIndex& other) { return detail::touch(place, other); });
  if (is_new) {
    looks.clear.push_back(place);
  }
  return is_new;
}

VANTAGE_INLINE TriedViews::Looks& TriedViews::new_look_at(const OccupancyMap& map, const VoxelIndex& unknown) {
  Looks& looks = looks_[unknown];
  may_hold_.insert(unknown);
  looks.known_neighbours = detail::known_around(map, unknown);
  looks.latest = plans_;
  return looks;
}

VANTAGE_INLINE void TriedViews::in_vain(const OccupancyMap& map, const VoxelIndex& unknown, const VoxelIndex& place) {
  Looks& looks = new_look_at(map, unknown);
  detail::add_if_it_differs(unknown, place, looks.in_vain);
  add_clear_look(map, looks, unknown, place);
}

VANTAGE_INLINE const TriedViews::Looks* TriedViews::looks_at(const VoxelIndex& unknown) const {
  if (!may_hold_.contains(unknown)) {
    return nullptr;
  }
  const auto found = looks_.find(unknown);
  return found == looks_.end() ? nullptr : &found->second;
}

VANTAGE_INLINE bool TriedViews::tried_from(const VoxelIndex& unknown, const VoxelIndex& place) const {
  const Looks* looks = looks_at(unknown);
  const auto alike = [&](const VoxelIndex& other) { return !detail::differ(unknown, place, other); };
  return looks != nullptr && (std::any_of(looks->in_vain.begin(), looks->in_vain.end(), alike) ||
                              std::find(looks->missed.begin(), looks->missed.end(), place) != looks->missed.end());
}

VANTAGE_INLINE bool TriedViews::hoped_in_vain(const VoxelIndex& unknown, const VoxelIndex& place) const {
  const Looks* looks = looks_at(unknown);
  return looks != nullptr && (gave_up(unknown) || tried_from(unknown, place) ||
                              looks->hoped.size() >= 2 * static_cast<std::size_t>(options_.patience) ||
                              std::find(looks->hoped.begin(), looks->hoped.end(), place) != looks->hoped.end());
}

VANTAGE_INLINE bool TriedViews::gave_up(const VoxelIndex& unknown) const {
  const Looks* looks = looks_at(unknown);
  const auto patience = static_cast<std::size_t>(options_.patience);
  return looks != nullptr &&
         (looks->in_vain.size() >= patience || looks->in_vain.size() + looks->missed.size() >= 2 * patience);
}

VANTAGE_INLINE bool TriedViews::tried_at_distance(const VoxelIndex& cell, const VoxelIndex& place) const {
  const Looks* looks = looks_at(cell);
  const double here = detail::squared_distance(cell, place);
  const auto is_alike = [&](const VoxelIndex& other) {
    const double there = detail::squared_distance(cell, other);
    return std::max(here, there) < 4.0 * std::min(here, there);
  };
  return looks != nullptr && std::any_of(looks->contested.begin(), looks->contested.end(), is_alike);
}

VANTAGE_INLINE bool TriedViews::looked_closely(const OccupancyMap& map, const VoxelIndex& unknown) const {
  const Looks* looks = looks_at(unknown);
  if (looks == nullptr) {
    return false;
  }
  const auto is_still_clear = [&](const VoxelIndex& place) { return detail::is_clear_from(map, place, unknown); };
  const auto most = 4 * static_cast<std::size_t>(options_.patience);
  return looks->in_vain.size() + looks->missed.size() >= most || looks->clear.size() >= most ||
         std::count_if(looks->clear.begin(), looks->clear.end(), is_still_clear) >= options_.patience;
}

VANTAGE_INLINE bool TriedViews::looked_from_beside(const OccupancyMap& map, const VoxelIndex& unknown,
                                                   const VoxelIndex& place) const {
  const Looks* looks = looks_at(unknown);
  const auto is_beside = [&](const VoxelIndex& other) {
    return detail::touch(place, other) && detail::is_clear_from(map, other, unknown);
  };
  return looks != nullptr && (std::any_of(looks->clear.begin(), looks->clear.end(), is_beside) ||
                              std::find(looks->missed.begin(), looks->missed.end(), place) != looks->missed.end());
}

}  // namespace vantage
