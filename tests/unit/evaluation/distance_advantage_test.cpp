// SPDX-License-Identifier: MIT
#include "evaluation/distance_advantage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/map/brick_set.hpp>

namespace vantage {
namespace {

constexpr double kCellM = 0.2;
using Lengths = std::map<VoxelIndex, double, RasterOrder>;

// Rooms with doors in a plane; those on one side are mostly full, so that few of their cells count.
std::vector<VoxelIndex> rooms(std::mt19937& engine) {
  std::vector<VoxelIndex> cells;
  const auto door_x = static_cast<std::int32_t>(engine() % 8);
  const auto door_y = static_cast<std::int32_t>(engine() % 8);
  for (std::int32_t y = 0; y < 50; ++y) {
    for (std::int32_t x = 0; x < 50; ++x) {
      const bool is_wall = (x % 10 == 9 && (y + x) % 8 != door_y) || (y % 10 == 9 && (y + x) % 8 != door_x);
      const bool is_full = x < 25 && x % 5 != 1 && y % 5 != 1;
      if (!is_wall && !is_full) {
        cells.push_back({x, y, 0});
      }
    }
  }
  return cells;
}

// By steps between cells that touch, past no corner.
Lengths lengths_by_cells(const std::vector<VoxelIndex>& cells, const VoxelIndex& from) {
  const std::set<VoxelIndex, RasterOrder> all(cells.begin(), cells.end());
  Lengths lengths;
  using Entry = std::pair<double, VoxelIndex>;
  const auto later = [](const Entry& a, const Entry& b) { return a.first > b.first; };
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> waiting(later);
  waiting.emplace(0.0, from);
  while (!waiting.empty()) {
    const auto [length, at] = waiting.top();
    waiting.pop();
    if (!lengths.emplace(at, length).second) {
      continue;
    }
    for (std::int32_t dy = -1; dy <= 1; ++dy) {
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        const VoxelIndex to = at + VoxelIndex{dx, dy, 0};
        if (all.contains(to) && all.contains(at + VoxelIndex{dx, 0, 0}) && all.contains(at + VoxelIndex{0, dy, 0})) {
          waiting.emplace(length + kCellM * std::hypot(dx, dy), to);
        }
      }
    }
  }
  return lengths;
}

TEST(DistanceAdvantage, IsThatOfAllCellsOneByOne) {
  std::mt19937 engine(1);
  std::size_t places = 0;
  std::size_t same_choice = 0;
  constexpr int kCases = 20;
  for (int seed = 0; seed < kCases; ++seed) {
    const std::vector<VoxelIndex> cells = rooms(engine);
    const BrickSet set(cells);
    detail::BlockWays ways(VoxelFrame{kCellM}, 4);
    ways.follow([&](const VoxelIndex& brick) {
      const BrickPlane* const plane = set.find(brick);
      return plane == nullptr ? BrickPlane{} : *plane;
    });
    VoxelIndex start;
    Lengths from_start;
    while (from_start.size() < 500) {  // not enclosed in a few cells, in which lengths are those of single steps
      start = cells[engine() % cells.size()];
      from_start = lengths_by_cells(cells, start);
    }
    std::vector<VoxelIndex> candidates;
    while (candidates.size() < 6) {
      const VoxelIndex cell = cells[engine() % cells.size()];
      if (from_start.contains(cell)) {
        candidates.push_back(cell);
      }
    }
    const std::vector<double> found = detail::distance_advantages(ways, start, candidates);
    std::vector<double> expected;
    for (const VoxelIndex& place : candidates) {
      const Lengths lengths = lengths_by_cells(cells, place);
      double sum_m = 0.0;
      for (const auto& [cell, length_m] : lengths) {
        sum_m += length_m;
      }
      const double mean_m = sum_m / static_cast<double>(lengths.size());
      expected.push_back(mean_m - lengths.at(start));
      EXPECT_NEAR(found[places++ % 6], expected.back(), 0.15 * mean_m) << seed;
    }
    const auto best = std::max_element(found.begin(), found.end()) - found.begin();
    const double most = *std::max_element(expected.begin(), expected.end());
    same_choice += expected[static_cast<std::size_t>(best)] > most - 0.5 ? 1U : 0U;
  }
  EXPECT_EQ(places, 6U * kCases);
  EXPECT_EQ(same_choice, kCases);
}

}  // namespace
}  // namespace vantage
