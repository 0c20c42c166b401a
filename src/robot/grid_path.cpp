// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <vantage/robot/grid_path.hpp>

namespace vantage {
namespace {

// Cost of a step through a face, an edge and a corner, in thousandths of a cell. Integers add without rounding.
constexpr std::array<std::uint32_t, 4> kStepCost{0, 1000, 1414, 1732};

std::size_t axes_of(const VoxelIndex& step) {
  return static_cast<std::size_t>((step.x != 0) + (step.y != 0) + (step.z != 0));
}

// The numbers of a cell and its 26 neighbours, x varies fastest.
using Around = std::array<std::uint32_t, 27>;

constexpr std::size_t place_of(const VoxelIndex& step) {
  return static_cast<std::size_t>(step.x + 1) + 3 * static_cast<std::size_t>(step.y + 1) +
         9 * static_cast<std::size_t>(step.z + 1);
}

bool cuts_no_corner(const Around& around, const VoxelIndex& step) {
  for (int part = 1; part < 8; ++part) {
    const VoxelIndex beside{(part & 1) != 0 ? step.x : 0, (part & 2) != 0 ? step.y : 0, (part & 4) != 0 ? step.z : 0};
    if (around[place_of(beside)] == ReachableSpace::kOutside) {
      return false;
    }
  }
  return true;
}

// Lower bound of the cost between two cells: the octile distance.
std::uint32_t bound(const VoxelIndex& from, const VoxelIndex& to) {
  std::array<std::uint32_t, 3> d{static_cast<std::uint32_t>(std::abs(to.x - from.x)),
                                 static_cast<std::uint32_t>(std::abs(to.y - from.y)),
                                 static_cast<std::uint32_t>(std::abs(to.z - from.z))};
  std::sort(d.begin(), d.end());
  return kStepCost[3] * d[0] + kStepCost[2] * (d[1] - d[0]) + kStepCost[1] * (d[2] - d[1]);
}

std::vector<VoxelIndex> way_back(const ReachableSpace& space, const std::vector<std::uint32_t>& before,
                                 std::uint32_t from) {
  std::vector<VoxelIndex> way;
  for (std::uint32_t at = from; at != ReachableSpace::kOutside; at = before[at]) {
    way.push_back(space.cells()[at]);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

// Best-first search from the start of the space until `is_goal(number, cost)`. `heuristic` must not overestimate.
template <class IsGoal, class Heuristic>
std::vector<VoxelIndex> search(const ReachableSpace& space, IsGoal&& is_goal, Heuristic&& heuristic) {
  std::vector<std::uint32_t> cost(space.size(), 0xFFFFFFFFU);
  std::vector<std::uint32_t> before(space.size(), ReachableSpace::kOutside);
  using Entry = std::pair<std::uint32_t, std::uint32_t>;  // cost + heuristic, cell number
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  auto number_of = space.numbers();
  Around around{};
  cost[0] = 0;
  open.emplace(heuristic(space.cells()[0]), 0U);
  while (!open.empty()) {
    const auto [estimate, number] = open.top();
    open.pop();
    const VoxelIndex cell = space.cells()[number];
    if (estimate != cost[number] + heuristic(cell)) {
      continue;
    }
    if (is_goal(number, cost[number])) {
      return way_back(space, before, number);
    }
    around[place_of({0, 0, 0})] = number;
    for (const VoxelIndex& step : kAllNeighbours) {
      around[place_of(step)] = number_of(cell + step);
    }
    for (const VoxelIndex& step : kAllNeighbours) {
      const std::uint32_t next = around[place_of(step)];
      const std::uint32_t reached = cost[number] + kStepCost[axes_of(step)];
      if (next != ReachableSpace::kOutside && reached < cost[next] &&
          (axes_of(step) == 1 || cuts_no_corner(around, step))) {
        cost[next] = reached;
        before[next] = number;
        open.emplace(reached + heuristic(cell + step), next);
      }
    }
  }
  return {};
}

// Removes corners: from each kept pose, a straight admitted motion leads to a corner far ahead, found by doubling and
// halving the stride. Empty if a single step is not admitted.
std::vector<Pose> shortcut(const OccupancyMap& map, const Platform& platform, const std::vector<Pose>& corners) {
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

}  // namespace

std::vector<bool> GridPaths::marked(std::span<const VoxelIndex> goals) const {
  std::vector<bool> is_goal(space_.size(), false);
  for (const VoxelIndex& goal : goals) {
    const std::uint32_t number = space_.number_of(goal);
    if (number != ReachableSpace::kOutside) {
      is_goal[number] = true;
    }
  }
  return is_goal;
}

std::vector<VoxelIndex> GridPaths::to_nearest(std::span<const VoxelIndex> goals) const {
  if (space_.size() == 0) {
    return {};
  }
  const std::vector<bool> is_goal = marked(goals);
  return search(
      space_, [&](std::uint32_t number, std::uint32_t) { return is_goal[number]; },
      [](const VoxelIndex&) { return 0U; });
}

std::vector<VoxelIndex> GridPaths::nearest_within(std::span<const VoxelIndex> goals, double detour_m,
                                                  double cell_m) const {
  std::vector<VoxelIndex> near;
  if (space_.size() == 0) {
    return near;
  }
  const std::vector<bool> is_goal = marked(goals);
  const double detour = std::min(1000.0 * detour_m / cell_m, 4e9);
  double furthest = 5e9;
  (void)search(
      space_,
      [&](std::uint32_t number, std::uint32_t cost) {
        if (cost > furthest) {
          return true;
        }
        if (is_goal[number]) {
          furthest = near.empty() ? cost + detour : furthest;
          near.push_back(space_.cells()[number]);
        }
        return false;
      },
      [](const VoxelIndex&) { return 0U; });
  return near;
}

std::vector<VoxelIndex> GridPaths::to(const VoxelIndex& goal) const {
  const std::uint32_t wanted = space_.number_of(goal);
  if (wanted == ReachableSpace::kOutside) {
    return {};
  }
  return search(
      space_, [&](std::uint32_t number, std::uint32_t) { return number == wanted; },
      [&](const VoxelIndex& cell) { return bound(cell, goal); });
}

std::optional<std::vector<Pose>> poses_along(const OccupancyMap& map, const Platform& platform, const Pose& from,
                                             std::span<const VoxelIndex> cells, const Pose& to) {
  std::vector<Pose> corners{from};
  for (const VoxelIndex& cell : cells) {
    corners.push_back(from);
    corners.back().translation() = map.frame().centre_of(cell);
  }
  corners.push_back(to);
  std::vector<Pose> poses = shortcut(map, platform, corners);
  if (poses.empty()) {
    return std::nullopt;
  }
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const Eigen::Vector3d position = poses[i].translation();
    const Eigen::Vector3d ahead = poses[i + 1].translation() - position;
    poses[i] = ahead.norm() > 1e-9 ? platform.facing(position, ahead) : poses[i - 1];
    poses[i].translation() = position;
  }
  poses.back() = to;
  return poses;
}

std::optional<std::vector<Pose>> grid_path(const OccupancyMap& map, const Platform& platform, const Pose& from,
                                           const Pose& to) {
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
