// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <vantage/map/brick_grid.hpp>
#include <vantage/robot/grid_path.hpp>

namespace vantage {
namespace detail {

// Cost of a step through a face, an edge and a corner, in thousandths of a cell. Integers add without rounding.
inline constexpr std::array<std::uint32_t, 4> kStepCost{0, 1000, 1414, 1732};

inline std::size_t axes_of(const VoxelIndex& step) {
  return static_cast<std::size_t>((step.x != 0) + (step.y != 0) + (step.z != 0));
}

inline constexpr std::uint32_t kNoCell = 0xFFFFFFFFU;  // not reachable
inline constexpr std::uint32_t kUnmet = kNoCell - 1;   // reachable, not met by the search

// Numbers the cells in the order in which a search meets them. The cost follows the bricks that it enters.
class MetCells {
 public:
  explicit MetCells(const ReachableSpace& space) : space_(space) {}

  // The number of a cell, to write to.
  std::uint32_t& operator()(const VoxelIndex& cell) {
    const VoxelIndex brick = Brick::of_cell(cell);
    if (values_ == nullptr || brick != brick_) {
      BrickDirectory::Number number = numbers_.number_of(brick);
      if (number == BrickDirectory::kNone) {
        number = numbers_.store(brick);
        enter(brick, numbers_.values(number));
      }
      brick_ = brick;
      values_ = &numbers_.values(number);
    }
    return (*values_)[Brick::offset_of(cell)];
  }

 private:
  void enter(const VoxelIndex& brick, BrickGrid<std::uint32_t>::Values& values) const {
    const BrickPlane* const reached = space_.find(brick);
    for (std::size_t word = 0; word < Brick::kWords && reached != nullptr; ++word) {
      for_each_offset((*reached)[word], word, [&](std::size_t offset) { values[offset] = kUnmet; });
    }
  }

  const ReachableSpace& space_;
  BrickGrid<std::uint32_t> numbers_{kNoCell};
  VoxelIndex brick_;
  BrickGrid<std::uint32_t>::Values* values_ = nullptr;
};

// Whether each of a cell and its 26 neighbours is reachable, x varies fastest.
using OpenNeighbours = std::array<bool, 27>;

constexpr std::size_t place_of(const VoxelIndex& step) {
  return static_cast<std::size_t>(step.x + 1) + 3 * static_cast<std::size_t>(step.y + 1) +
         9 * static_cast<std::size_t>(step.z + 1);
}

inline bool cuts_no_corner(const OpenNeighbours& around, const VoxelIndex& step) {
  for (int part = 1; part < 8; ++part) {
    const VoxelIndex beside{(part & 1) != 0 ? step.x : 0, (part & 2) != 0 ? step.y : 0, (part & 4) != 0 ? step.z : 0};
    if (!around[place_of(beside)]) {
      return false;
    }
  }
  return true;
}

// Lower bound of the cost between two cells: the octile distance.
inline std::uint32_t bound(const VoxelIndex& from, const VoxelIndex& to) {
  std::array<std::uint32_t, 3> d{static_cast<std::uint32_t>(std::abs(to.x - from.x)),
                                 static_cast<std::uint32_t>(std::abs(to.y - from.y)),
                                 static_cast<std::uint32_t>(std::abs(to.z - from.z))};
  std::sort(d.begin(), d.end());
  return kStepCost[3] * d[0] + kStepCost[2] * (d[1] - d[0]) + kStepCost[1] * (d[2] - d[1]);
}

struct Met {
  VoxelIndex cell;
  std::uint32_t cost;
  std::uint32_t before;  // number of the cell before it
};

// Best-first search from `start` until `is_goal(cell, cost)`. `heuristic` must not overestimate.
// `met` receives the cells that it meets, by number.
template <class IsGoal, class Heuristic>
std::vector<VoxelIndex> search(const ReachableSpace& space, const std::optional<VoxelIndex>& start, IsGoal&& is_goal,
                               Heuristic&& heuristic, std::vector<Met>& met) {
  using Entry = std::pair<std::uint32_t, std::uint32_t>;  // cost + heuristic, number
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  MetCells number_of(space);
  if (!start) {
    return {};
  }
  number_of(*start) = 0;
  met.push_back({*start, 0, kNoCell});
  open.emplace(heuristic(*start), 0U);
  std::array<std::uint32_t*, 27> numbers{};
  OpenNeighbours around{};
  around[place_of({0, 0, 0})] = true;
  while (!open.empty()) {
    const auto [estimate, number] = open.top();
    open.pop();
    const auto [cell, cost, before] = met[number];
    if (estimate != cost + heuristic(cell)) {
      continue;
    }
    if (is_goal(cell, cost)) {
      std::vector<VoxelIndex> way;
      for (std::uint32_t at = number; at != kNoCell; at = met[at].before) {
        way.push_back(met[at].cell);
      }
      std::reverse(way.begin(), way.end());
      return way;
    }
    for (const VoxelIndex& step : kAllNeighbours) {
      numbers[place_of(step)] = &number_of(cell + step);
      around[place_of(step)] = *numbers[place_of(step)] != kNoCell;
    }
    for (const VoxelIndex& step : kAllNeighbours) {
      const std::size_t place = place_of(step);
      const std::uint32_t reached = cost + kStepCost[axes_of(step)];
      if (!around[place] || (axes_of(step) > 1 && !cuts_no_corner(around, step))) {
        continue;
      }
      std::uint32_t& next = *numbers[place];
      if (next == kUnmet) {
        next = static_cast<std::uint32_t>(met.size());
        met.push_back({cell + step, reached, number});
      } else if (reached < met[next].cost) {
        met[next].cost = reached;
        met[next].before = number;
      } else {
        continue;
      }
      open.emplace(reached + heuristic(cell + step), next);
    }
  }
  return {};
}

// Removes corners: from each kept pose, a straight admitted motion leads to a corner far ahead, found by doubling and
// halving the stride. Empty if a single step is not admitted.
inline std::vector<Pose> shortcut(const OccupancyMap& map, const Platform& platform,
                                  const std::vector<Pose>& corners) {
  std::vector<Pose> kept{corners.front()};
  std::size_t at = 0;
  const auto straight_to = [&](std::size_t to) {
    return to < corners.size() && platform.admits_motion(map, corners[at], corners[to]);
  };
  while (at + 1 < corners.size()) {
    if (!straight_to(at + 1)) {
      return {};
    }
    std::size_t stride = 1;
    while (straight_to(at + 2 * stride)) {
      stride *= 2;
    }
    std::size_t furthest = at + stride;
    for (; stride > 0; stride /= 2) {
      if (straight_to(furthest + stride)) {
        furthest += stride;
      }
    }
    kept.push_back(corners[furthest]);
    at = furthest;
  }
  return kept;
}

// The poses of a path; those between its ends look along it.
inline std::vector<Pose> looking_ahead(const Platform& platform, std::vector<Pose> poses) {
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const Eigen::Vector3d position = poses[i].translation();
    const Eigen::Vector3d ahead = poses[i + 1].translation() - position;
    poses[i] = ahead.norm() > 1e-9 ? platform.facing(position, ahead) : poses[i - 1];
    poses[i].translation() = position;
  }
  return poses;
}

inline bool are_admitted_motions(const OccupancyMap& map, const Platform& platform, const std::vector<Pose>& poses) {
  return std::adjacent_find(poses.begin(), poses.end(), [&](const Pose& from, const Pose& to) {
           return !platform.admits_motion(map, from, to);
         }) == poses.end();
}

}  // namespace detail

VANTAGE_INLINE std::vector<VoxelIndex> GridPaths::to_nearest(std::span<const VoxelIndex> goals) const {
  const BrickSet wanted(goals);
  std::vector<detail::Met> met;
  return detail::search(
      space_, start_, [&](const VoxelIndex& cell, std::uint32_t) { return wanted.contains(cell); },
      [](const VoxelIndex&) { return 0U; }, met);
}

VANTAGE_INLINE NearGoals GridPaths::nearest_within(std::span<const VoxelIndex> goals, double detour_m,
                                                   double cell_m) const {
  NearGoals near;
  const BrickSet wanted(goals);
  const double detour = std::min(1000.0 * detour_m / cell_m, 4e9);
  double furthest = 5e9;
  std::vector<detail::Met> met;
  (void)detail::search(
      space_, start_,
      [&](const VoxelIndex& cell, std::uint32_t cost) {
        if (cost > furthest) {
          return true;
        }
        if (wanted.contains(cell)) {
          furthest = near.goals.empty() ? cost + detour : furthest;
          near.goals.push_back(cell);
        }
        return false;
      },
      [](const VoxelIndex&) { return 0U; }, met);
  std::for_each(met.begin(), met.end(), [&](const detail::Met& one) { near.met.insert(one.cell); });
  return near;
}

VANTAGE_INLINE std::vector<VoxelIndex> GridPaths::to(const VoxelIndex& goal) const {
  if (!space_.contains(goal)) {
    return {};
  }
  std::vector<detail::Met> met;
  return detail::search(
      space_, start_, [&](const VoxelIndex& cell, std::uint32_t) { return cell == goal; },
      [&](const VoxelIndex& cell) { return detail::bound(cell, goal); }, met);
}

VANTAGE_INLINE std::optional<std::vector<Pose>> poses_along(const OccupancyMap& map, const Platform& platform,
                                                            const Pose& from, std::span<const VoxelIndex> cells,
                                                            const Pose& to) {
  std::vector<Pose> corners{from};
  for (const VoxelIndex& cell : cells) {
    corners.push_back(from);
    corners.back().translation() = map.frame().centre_of(cell);
  }
  corners.push_back(to);
  // A body that is no sphere may fit along the path in one orientation and not in another: straight on and looking
  // ahead, turned as it stands, or looking ahead from cell to cell.
  std::vector<Pose> straight = detail::shortcut(map, platform, corners);
  for (const std::vector<Pose>* poses : {&straight, &corners}) {
    std::vector<Pose> ahead = detail::looking_ahead(platform, *poses);
    if (!ahead.empty() && detail::are_admitted_motions(map, platform, ahead)) {
      return ahead;
    }
  }
  return straight.empty() ? std::nullopt : std::optional(std::move(straight));
}

VANTAGE_INLINE std::optional<std::vector<Pose>> grid_path(const OccupancyMap& map, const Platform& platform,
                                                          const Pose& from, const Pose& to) {
  if (!platform.admits(map, to)) {
    return std::nullopt;
  }
  const ReachableSpace space(map, platform, from);
  const std::vector<VoxelIndex> cells = GridPaths(space).to(map.frame().cell_of(to.translation()));
  if (cells.empty()) {
    return std::nullopt;
  }
  return poses_along(map, platform, from, cells, to);
}

}  // namespace vantage
