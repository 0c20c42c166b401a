// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/frontier/void_tracker.hpp>

#include "support/qhull.hpp"
#include "support/random_maps.hpp"

namespace vantage {
namespace {

TEST(VoidCells, AreTheUnknownCellsInTheHullCellByCell) {
  std::mt19937 engine(31);
  std::size_t void_count = 0;
  for (int world = 0; world < 12; ++world) {
    OccupancyMapOptions options{.resolution_m = 0.1};
    if (world % 2 == 1) {
      options.region = Box{{-1.1, -0.7, -2.0}, {2.3, 1.9, 0.9}};
    }
    OccupancyMap map(options);
    for (int scan = 0; scan < 3; ++scan) {
      map.insert(test::random_scan(engine, 60 + 5 * static_cast<std::size_t>(world)));
    }
    const test::QhullHull hull = test::qhull_of_occupied(map);
    ASSERT_FALSE(hull.empty());
    const LatticeHull exact = occupied_hull(map);
    map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      EXPECT_TRUE(state != Occupancy::Occupied || exact.contains(cell));
    });
    std::vector<VoxelIndex> expected;
    for_each_cell(map.bounds().grown(2), [&](const VoxelIndex& cell) {
      if (map.in_region(cell) && map.at(cell) == Occupancy::Unknown && hull.contains(cell)) {
        expected.push_back(cell);
      }
    });
    EXPECT_EQ(void_cells(map), expected);
    EXPECT_EQ(count_void_cells(map), expected.size());
    void_count += expected.size();
  }
  EXPECT_GT(void_count, 500'000U);
}

TEST(VoidCells, AFacetBelongsToTheHull) {
  OccupancyMap map({.resolution_m = 0.1});
  for (int corner = 0; corner < 8; ++corner) {
    map.set({4 * (corner & 1), 5 * (corner >> 1 & 1), 6 * (corner >> 2)}, Occupancy::Occupied);
  }
  EXPECT_EQ(count_void_cells(map), 5U * 6 * 7 - 8);
  map.set({1, 1, 1}, Occupancy::Free);
  EXPECT_EQ(count_void_cells(map), 5U * 6 * 7 - 9);
}

TEST(VoidCells, WithoutVolumeThereAreNone) {
  OccupancyMap map;
  EXPECT_TRUE(void_cells(map).empty());
  for (std::int32_t i = 0; i < 30; ++i) {
    map.set({i % 5, i / 5, 3}, Occupancy::Occupied);
  }
  EXPECT_TRUE(void_cells(map).empty());
  EXPECT_TRUE(occupied_hull(map).empty());
}

// Four cells 10 km apart: only the part of the hull near known cells counts, and only that part takes time.
TEST(VoidCells, OfAHugeHullAreNearWhatIsKnown) {
  OccupancyMap map({.resolution_m = 0.1});
  const std::vector<VoxelIndex> corners{{0, 0, 0}, {100'000, 0, 0}, {0, 100'000, 0}, {0, 0, 100'000}};
  for (const VoxelIndex& corner : corners) {
    map.set(corner, Occupancy::Occupied);
  }
  const std::vector<VoxelIndex> voids = void_cells(map);
  EXPECT_EQ(count_void_cells(map), voids.size());
  EXPECT_EQ(VoidTracker(map).cells(), voids);
  // The corner at the origin: all of its tile and of the neighbouring tiles, where they are inside the hull.
  EXPECT_EQ(std::count_if(voids.begin(), voids.end(),
                          [](const VoxelIndex& cell) {
                            return VoxelBox{{0, 0, 0}, {128, 128, 128}}.contains(cell);
                          }),
            128 * 128 * 128 - 1);
  EXPECT_LT(voids.size(), 5'000'000U);
}

}  // namespace
}  // namespace vantage
