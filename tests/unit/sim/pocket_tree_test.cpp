// SPDX-License-Identifier: MIT
#include "sim/pocket_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vantage/robot/free_flyer.hpp>

namespace vantage {
namespace {

// The cells that a point robot reaches from cell (0, 0, 0).
template <class IsSolid>
NumberedCells space_of(const VoxelIndex& extent, const IsSolid& is_solid) {
  OccupancyMap map({.resolution_m = 1.0});
  for_each_cell({{0, 0, 0}, extent}, [&](const VoxelIndex& cell) {
    map.set(cell, is_solid(cell) ? Occupancy::Occupied : Occupancy::Free);
  });
  return NumberedCells(ReachableSpace(map, FreeFlyer(FreeFlyerOptions{.radius_m = 0.1, .margin_m = 0.0}),
                                      pose_looking({0.5, 0.5, 0.5}, 0.0)));
}

// The places within a distance of a random one.
std::vector<std::uint32_t> random_places(const StepGraph& graph, std::mt19937& engine) {
  const std::vector<std::uint32_t> middle{static_cast<std::uint32_t>(engine() % graph.size())};
  const std::vector<float> distance = distances_from(graph, middle);
  const float radius = static_cast<float>(engine() % 3);
  std::vector<std::uint32_t> places;
  for (std::uint32_t place = 0; place < graph.size(); ++place) {
    if (distance[place] <= radius) {
      places.push_back(place);
    }
  }
  return places;
}

TEST(PocketTree, NeverMoreThanTheShortestRoute) {
  std::size_t cases = 0;
  double share = 0.0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    std::mt19937 engine(seed);
    std::bernoulli_distribution block(seed % 2 == 0 ? 0.3 : 0.45);
    const NumberedCells space = space_of({15, 15, seed % 4 == 0 ? 2 : 1}, [&](const VoxelIndex& cell) {
      return block(engine) && cell != VoxelIndex{0, 0, 0};
    });
    if (space.size() < 20) {
      continue;
    }
    const StepGraph graph(space);
    PocketTree pockets(graph);
    std::vector<std::uint16_t> member(space.size(), 0);
    const std::size_t sets = 1 + engine() % 5;
    for (std::size_t set = 0; set < sets; ++set) {
      const std::vector<std::uint32_t> places = random_places(graph, engine);
      for (const std::uint32_t place : places) {
        member[place] = static_cast<std::uint16_t>(member[place] | (1U << set));
      }
      pockets.make_due(pockets.pocket_of(places));
    }
    const double shortest = shortest_visit(graph, member, sets).length;
    ASSERT_LE(pockets.bound(), shortest + 1e-3) << "seed " << seed;
    share += shortest > 0.0 ? pockets.bound() / shortest : 1.0;
    ++cases;
  }
  EXPECT_GT(cases, 80U);
  EXPECT_GT(share / static_cast<double>(cases), 0.5) << "or it means little";
}

// A corridor of one cell with dead ends.
TEST(PocketTree, NearlyTheShortestRouteWhereTheWaysAreATree) {
  const NumberedCells space =
      space_of({21, 9, 1}, [](const VoxelIndex& cell) { return cell.y != 0 && cell.x % 5 != 4; });
  const StepGraph graph(space);
  PocketTree pockets(graph);
  std::vector<std::uint16_t> member(space.size(), 0);
  const std::vector<VoxelIndex> ends{{4, 8, 0}, {9, 5, 0}, {19, 2, 0}};
  for (std::size_t end = 0; end < ends.size(); ++end) {
    const std::uint32_t place = space.number_of(ends[end]);
    member[place] = static_cast<std::uint16_t>(1U << end);
    pockets.make_due(pockets.pocket_of(std::vector<std::uint32_t>{place}));
    EXPECT_TRUE(pockets.is_due(place));
  }
  EXPECT_FALSE(pockets.is_due(space.number_of({9, 6, 0})));
  const double shortest = shortest_visit(graph, member, ends.size()).length;
  EXPECT_LE(pockets.bound(), shortest + 1e-3);
  EXPECT_GE(pockets.bound(), 0.9 * shortest) << "a dead end is a pocket of its own once no step cuts its corner";
}

TEST(PocketTree, PlacesThatTheStartIsAmongNeedNoWay) {
  const NumberedCells space = space_of({11, 1, 1}, [](const VoxelIndex&) { return false; });
  const StepGraph graph(space);
  PocketTree pockets(graph);
  EXPECT_EQ(pockets.bound(), 0.0);
  pockets.make_due(pockets.pocket_of(std::vector<std::uint32_t>{0, 10}));
  EXPECT_EQ(pockets.bound(), 0.0) << "the start is one of the places";
  EXPECT_EQ(pockets.gain(space.number_of({10, 0, 0})), 10.0);
  pockets.make_due(
      pockets.pocket_of(std::vector<std::uint32_t>{space.number_of({4, 0, 0}), space.number_of({7, 0, 0})}));
  EXPECT_EQ(pockets.bound(), 4.0) << "there and not back";
  const std::uint32_t pocket = pockets.pocket_of(std::vector<std::uint32_t>{2, 9});
  EXPECT_TRUE(pockets.is_due(pocket));
  EXPECT_EQ(pockets.gain(pocket), 0.0);
}

}  // namespace
}  // namespace vantage
