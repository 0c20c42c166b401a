// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <random>
#include <set>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/raster_order.hpp>

namespace vantage {
namespace {

// A map of random boxes and cells around the origin, so that negative coordinates occur.
OccupancyMap random_map(std::mt19937& engine, bool with_region) {
  OccupancyMapOptions options{.resolution_m = 0.1};
  std::uniform_int_distribution<std::int32_t> coordinate(-14, 14);
  if (with_region) {
    const Eigen::Vector3d lo(0.1 * coordinate(engine) - 0.6, 0.1 * coordinate(engine) - 0.6,
                             0.1 * coordinate(engine) - 0.6);
    options.region = Box{lo, lo + Eigen::Vector3d(1.3, 1.7, 2.1)};
  }
  OccupancyMap map(options);
  std::uniform_int_distribution<std::int32_t> extent(1, 12);
  for (int box = 0; box < 6; ++box) {
    const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
    const Occupancy state = box % 3 == 2 ? Occupancy::Occupied : Occupancy::Free;
    for_each_cell({lo, lo + VoxelIndex{extent(engine), extent(engine), extent(engine)}},
                  [&](const VoxelIndex& cell) { map.set(cell, state); });
  }
  for (int i = 0; i < 60; ++i) {
    const auto state = static_cast<Occupancy>(i % 3);
    map.set({coordinate(engine), coordinate(engine), coordinate(engine)}, state);
  }
  return map;
}

bool is_frontier(const OccupancyMap& map, const VoxelIndex& cell) {
  return map.at(cell) == Occupancy::Free &&
         std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(), [&](const VoxelIndex& step) {
           return map.in_region(cell + step) && map.at(cell + step) == Occupancy::Unknown;
         });
}

TEST(Frontiers, AgreeWithTheDefinitionCellByCell) {
  std::mt19937 engine(7);
  std::size_t frontier = 0;
  std::size_t compared = 0;
  for (int world = 0; world < 200; ++world) {
    const OccupancyMap map = random_map(engine, world % 2 == 1);
    std::vector<VoxelIndex> expected;
    for_each_cell({{-34, -34, -34}, {34, 34, 34}}, [&](const VoxelIndex& cell) {
      if (is_frontier(map, cell)) {
        expected.push_back(cell);
      }
      ++compared;
    });
    EXPECT_EQ(frontier_cells(map), expected) << "world " << world;
    EXPECT_EQ(count_frontier_cells(map), expected.size());
    frontier += expected.size();
  }
  EXPECT_EQ(compared, 200U * 68 * 68 * 68);
  EXPECT_GT(frontier, 50'000U);
}

TEST(Frontiers, ThePlaneOfABrickNotSeenIsEmpty) {
  const OccupancyMap map;
  EXPECT_EQ(frontier_plane(map, {3, -4, 5}), BrickPlane{});
  EXPECT_TRUE(frontier_cells(map).empty());
  EXPECT_TRUE(frontier_clusters({}).empty());
}

TEST(Frontiers, ARegionFilledToItsBordersHasNone) {
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{-0.5, -0.5, -0.5}, {0.7, 0.9, 1.1}}});
  map.assume_free({{-2, -2, -2}, {2, 2, 2}});
  EXPECT_EQ(map.counts().free, 12U * 14 * 16);
  EXPECT_EQ(count_frontier_cells(map), 0U);
  map.set({0, 0, 0}, Occupancy::Unknown);
  EXPECT_EQ(count_frontier_cells(map), 6U);
}

bool neighbours(const VoxelIndex& a, const VoxelIndex& b, Connectivity connectivity) {
  const VoxelIndex step = a - b;
  const int furthest = std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)});
  const int sum = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
  const int limit = connectivity == Connectivity::Face6 ? 1 : connectivity == Connectivity::Edge18 ? 2 : 3;
  return furthest == 1 && sum <= limit;
}

// Slow flood fill over all pairs.
std::vector<std::vector<VoxelIndex>> flood(const std::vector<VoxelIndex>& cells, Connectivity connectivity) {
  std::vector<bool> seen(cells.size(), false);
  std::vector<std::vector<VoxelIndex>> clusters;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (seen[i]) {
      continue;
    }
    std::deque<std::size_t> open{i};
    seen[i] = true;
    clusters.emplace_back();
    while (!open.empty()) {
      const std::size_t here = open.front();
      open.pop_front();
      clusters.back().push_back(cells[here]);
      for (std::size_t j = 0; j < cells.size(); ++j) {
        if (!seen[j] && neighbours(cells[here], cells[j], connectivity)) {
          seen[j] = true;
          open.push_back(j);
        }
      }
    }
    std::sort(clusters.back().begin(), clusters.back().end(), RasterOrder{});
  }
  return clusters;
}

TEST(Frontiers, ClustersAreThoseOfAFloodFill) {
  std::mt19937 engine(8);
  std::size_t clusters_seen = 0;
  std::size_t differing = 0;
  for (int world = 0; world < 40; ++world) {
    const std::vector<VoxelIndex> cells = frontier_cells(random_map(engine, false));
    // Keep a fifth of the cells, so that there are many clusters of all shapes.
    std::vector<VoxelIndex> kept;
    std::sample(cells.begin(), cells.end(), std::back_inserter(kept), cells.size() / 5, engine);
    std::vector<VoxelIndex> shuffled = kept;
    std::shuffle(shuffled.begin(), shuffled.end(), engine);
    shuffled.push_back(shuffled.front());
    std::set<std::size_t> counts;
    for (const Connectivity connectivity : {Connectivity::Face6, Connectivity::Edge18, Connectivity::Corner26}) {
      const auto expected = flood(kept, connectivity);
      EXPECT_EQ(frontier_clusters(shuffled, connectivity), expected);
      clusters_seen += expected.size();
      counts.insert(expected.size());
    }
    differing += counts.size() == 3 ? 1U : 0U;
  }
  EXPECT_GT(clusters_seen, 5'000U);
  EXPECT_GT(differing, 30U) << "the three connectivities must differ for the comparison to mean anything";
}

}  // namespace
}  // namespace vantage
