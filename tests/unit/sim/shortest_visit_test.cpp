// SPDX-License-Identifier: MIT
#include "sim/shortest_visit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vantage/robot/free_flyer.hpp>

namespace vantage {
namespace {

// A box with some blocked cells, and the reachable space of a point robot in it.
class BlockedBox {
 public:
  BlockedBox(const VoxelIndex& extent, double blocked, std::uint32_t seed) : map_({.resolution_m = 1.0}) {
    std::mt19937 engine(seed);
    std::bernoulli_distribution block(blocked);
    for_each_cell({{0, 0, 0}, extent}, [&](const VoxelIndex& cell) {
      const bool is_blocked = block(engine) && cell != VoxelIndex{0, 0, 0};
      map_.set(cell, is_blocked ? Occupancy::Occupied : Occupancy::Free);
    });
  }
  [[nodiscard]] NumberedCells space() const {
    return NumberedCells(ReachableSpace(map_, FreeFlyer(FreeFlyerOptions{.radius_m = 0.1, .margin_m = 0.0}),
                                        pose_looking({0.5, 0.5, 0.5}, 0.0)));
  }

 private:
  OccupancyMap map_;
};

TEST(ShortestVisit, InTheOpenWideStepsAreAtMostFivePercentLonger) {
  const BlockedBox box({14, 14, 14}, 0.0, 1);
  const NumberedCells space = box.space();
  const std::vector<std::uint32_t> start{0};
  const std::vector<float> distance = distances_from(StepGraph(space), start);
  double longest = 0.0;
  for (std::size_t cell = 1; cell < space.size(); ++cell) {
    const VoxelIndex by = space.cells()[cell] - space.cells()[0];
    const double straight = std::sqrt(by.x * by.x + by.y * by.y + by.z * by.z);
    longest = std::max(longest, distance[cell] / straight);
    ASSERT_GT(distance[cell], 0.9999 * straight);
  }
  EXPECT_EQ(wide_steps().size(), 98U);
  EXPECT_EQ(space.size(), 14U * 14U * 14U);
  EXPECT_LT(longest, 1.05);
  EXPECT_GT(longest, 1.04) << "so that the bound means something";
}

// Exhaustive search over all orders of the sets and all members, with all pairwise distances.
double shortest_by_trying(const NumberedCells& space, const std::vector<std::uint16_t>& member, std::size_t sets) {
  std::vector<std::vector<float>> distance;
  const StepGraph graph(space);
  for (std::uint32_t cell = 0; cell < space.size(); ++cell) {
    distance.push_back(distances_from(graph, std::vector<std::uint32_t>{cell}));
  }
  std::vector<std::size_t> order(sets);
  std::iota(order.begin(), order.end(), std::size_t{0});
  double shortest = std::numeric_limits<double>::infinity();
  do {
    std::vector<double> to_here(space.size(), std::numeric_limits<double>::infinity());
    to_here[0] = 0.0;
    for (const std::size_t set : order) {
      std::vector<double> next(space.size(), std::numeric_limits<double>::infinity());
      for (std::size_t to = 0; to < space.size(); ++to) {
        for (std::size_t from = 0; from < space.size() && (std::uint32_t{member[to]} >> set & 1U) != 0; ++from) {
          next[to] = std::min(next[to], to_here[from] + double{distance[from][to]});
        }
      }
      to_here = std::move(next);
    }
    shortest = std::min(shortest, *std::min_element(to_here.begin(), to_here.end()));
  } while (std::next_permutation(order.begin(), order.end()));
  return shortest;
}

TEST(ShortestVisit, IsTheShortestOfAllOrdersAndPlaces) {
  std::size_t visits = 0;
  std::size_t out_of_reach = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const BlockedBox box({7, 6, 3}, 0.35, seed);
    const NumberedCells space = box.space();
    std::mt19937 engine(seed);
    const std::size_t sets = 1 + seed % 4;
    std::vector<std::uint16_t> member(space.size(), 0);
    for (std::size_t set = 0; set < sets; ++set) {
      for (std::uint32_t places = engine() % 4; places > 0; --places) {
        std::uint16_t& one = member[engine() % space.size()];
        one = static_cast<std::uint16_t>(one | 1U << set);
      }
    }
    const Visit visit = shortest_visit(StepGraph(space), member, sets);
    const double shortest = shortest_by_trying(space, member, sets);
    if (!std::isfinite(shortest)) {
      EXPECT_TRUE(visit.cells.empty());
      ++out_of_reach;
      continue;
    }
    ASSERT_NEAR(visit.length, shortest, 1e-4) << "seed " << seed;
    // The path is connected and has the stated length.
    double length = 0.0;
    std::uint16_t visited = member[visit.cells.front()];
    for (std::size_t i = 1; i < visit.cells.size(); ++i) {
      const VoxelIndex by = space.cells()[visit.cells[i]] - space.cells()[visit.cells[i - 1]];
      ASSERT_LE(std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}), 2);
      length += std::sqrt(by.x * by.x + by.y * by.y + by.z * by.z);
      visited = static_cast<std::uint16_t>(visited | member[visit.cells[i]]);
    }
    EXPECT_EQ(visit.cells.front(), 0U);
    EXPECT_NEAR(length, visit.length, 1e-4);
    EXPECT_EQ(visited, (1U << sets) - 1);
    ++visits;
  }
  EXPECT_GE(visits, 25U);
  EXPECT_GE(out_of_reach, 10U);
}

}  // namespace
}  // namespace vantage
