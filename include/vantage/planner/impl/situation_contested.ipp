// SPDX-License-Identifier: MIT
#pragma once

// Contested cells between the robot and a place with more to see: rays passed through them and rays ended in them or,
// in the plane of a HeightBand, no floor was seen there. No body may be in them, so the robot looks at them again.
//
//       reachable cells         contested
//     . . . . . . . . . . . | c c c c c c | . . place beyond . .   ? ? ?  unknown
//           ^     ^     ^
//           |     |     +--- first look, from the nearest place
//           +-----+--- in vain: from places at half or twice the distance,
//                      because a level sensor sees the floor from some distances only
#include <algorithm>
#include <utility>
#include <vantage/planner/situation.hpp>
#include <vantage/robot/grid_path.hpp>

namespace vantage {
namespace detail {

inline std::vector<VoxelIndex> contested_cells(const OccupancyMap& map) {
  std::vector<VoxelIndex> cells;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    if (state == Occupancy::Free && map.contested(cell)) {
      cells.push_back(cell);
    }
  });
  return cells;
}

}  // namespace detail

// The map as if its contested cells were clear. None if it has none.
VANTAGE_INLINE std::optional<OccupancyMap> Situation::map_without_contested() const {
  const std::vector<VoxelIndex> cells = detail::contested_cells(*map_);
  if (cells.empty()) {
    return std::nullopt;
  }
  OccupancyMap open = *map_;
  for (const VoxelIndex& cell : cells) {
    open.set(cell, Occupancy::Free);
  }
  return open;
}

// A view of contested cells that are in the way to a place with more to see.
VANTAGE_INLINE std::optional<Plan> Situation::look_at_contested() {
  std::optional<OccupancyMap> open = map_without_contested();
  while (open) {  // ends, because each round closes cells
    const ReachableSpace space(*open, platform(), current_);
    const std::optional<VoxelIndex> beyond = viewpoint_among(out_of_reach(space.cells(), body_m()));
    const std::vector<VoxelIndex> cells =
        beyond ? contested_on_way(*open, space, *beyond) : std::vector<VoxelIndex>();
    if (cells.empty()) {
      break;
    }
    for (const VoxelIndex& cell : cells) {
      if (std::optional<Plan> look = look_again_at(cell)) {
        return look;
      }
    }
    for (const VoxelIndex& cell : cells) {
      open->set(cell, Occupancy::Occupied);
    }
  }
  return std::nullopt;
}

// The contested cells, clear in `open`, around the first place on the way to `goal` that cannot be reached.
VANTAGE_INLINE std::vector<VoxelIndex> Situation::contested_on_way(const OccupancyMap& open,
                                                                   const ReachableSpace& space,
                                                                   const VoxelIndex& goal) const {
  std::vector<VoxelIndex> cells;
  const std::vector<VoxelIndex> way = GridPaths(space).to(goal);
  const auto first =
      std::find_if(way.begin(), way.end(), [&](const VoxelIndex& cell) { return !reachable().contains(cell); });
  if (first != way.end()) {
    Pose pose = current_;
    pose.translation() = space.position_in(*first);
    for_each_cell(map_->frame().cells_touched_by(platform().body_box(pose)).grown(1), [&](const VoxelIndex& cell) {
      if (map_->contested(cell) && open.is_clear(cell)) {
        cells.push_back(cell);
      }
    });
  }
  return cells;
}

// A view of `cell` from the nearest place at a distance from which neither a look nor a scan on the way saw it. All
// contested cells in view that were not looked at from there are sought, so that one look serves a whole edge.
VANTAGE_INLINE std::optional<Plan> Situation::look_again_at(const VoxelIndex& cell) const {
  Plan plan = open_plan();
  const auto view_from = [&](const VoxelIndex& place) {
    const Eigen::Vector3d position = reachable().position_in(place);
    return platform().facing(position, map_->frame().centre_of(cell) - position);
  };
  const auto is_seen_in = [&](const Pose& view, const VoxelIndex& one) {
    return sees(*map_, sensor(), view, one, plan.statistics.ray_operations);
  };
  std::vector<double> seen_from_m;
  for (const Pose& scanned : tried_.scanned_from()) {
    if (is_seen_in(scanned, cell)) {
      seen_from_m.push_back((map_->frame().centre_of(cell) - scanned.translation()).norm());
    }
  }
  const auto was_seen_from = [&](const VoxelIndex& place) {
    const double from_m = (map_->frame().centre_of(cell) - reachable().position_in(place)).norm();
    return std::any_of(seen_from_m.begin(), seen_from_m.end(),
                       [&](double other_m) { return std::max(from_m, other_m) < 2.0 * std::min(from_m, other_m); });
  };
  std::vector<VoxelIndex> places = reachable().cells();
  std::erase_if(places, [&](const VoxelIndex& place) {
    return tried_.rests(place) || tried_.tried_at_distance(cell, place) || was_seen_from(place) ||
           !is_seen_in(view_from(place), cell);
  });
  constexpr int kMostTries = 16;
  for (int tries = 0; tries < kMostTries && !places.empty(); ++tries) {
    const std::vector<VoxelIndex> way = GridPaths(reachable()).to_nearest(places);
    const Pose view = view_from(way.back());
    if (std::optional<std::vector<Pose>> path = path_to(view, way)) {
      plan.outcome = Outcome::Move;
      plan.goal.pose = view;
      plan.path = *std::move(path);
      for (const VoxelIndex& one : detail::contested_cells(*map_)) {
        if (!tried_.tried_at_distance(one, way.back()) && is_seen_in(view, one)) {
          plan.sought.push_back(one);
        }
      }
      plan.reason = "a look at contested cells in the way to a place with more to see";
      return plan;
    }
    std::erase(places, way.back());
  }
  return std::nullopt;
}

}  // namespace vantage
