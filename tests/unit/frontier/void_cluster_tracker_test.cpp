// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>
#include <vantage/frontier/void_cluster_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

namespace vantage {
namespace {

const VoxelFrame kTenCm{0.1};

VoxelIndex tile_of(const VoxelIndex& cell) { return {cell.x >> 6, cell.y >> 6, cell.z >> 6}; }

// Adds or removes the cells of a random box that may lie in several tiles.
void add_or_remove(std::set<VoxelIndex, RasterOrder>& cells, std::mt19937& engine) {
  std::uniform_int_distribution<std::int32_t> at(-100, 100);
  std::uniform_int_distribution<std::int32_t> side(1, 14);
  const VoxelIndex lo{at(engine), at(engine), at(engine) / 3};
  const bool adds = engine() % 3 != 0;
  for_each_cell({lo, lo + VoxelIndex{2 * side(engine), side(engine), side(engine)}}, [&](const VoxelIndex& cell) {
    if (adds) {
      cells.insert(cell);
    } else {
      cells.erase(cell);
    }
  });
}

// Compares with clusters of each tile from nothing, after each of many changes.
TEST(VoidClusterTracker, HoldsTheClustersOfEachTile) {
  std::mt19937 engine(91);
  std::size_t clusters = 0;
  std::size_t tiles = 0;
  for (int world = 0; world < 3; ++world) {
    const VoidClusterOptions options{.min_score = 0.6, .seed = engine()};
    VoidClusterTracker tracker(options);
    std::set<VoxelIndex, RasterOrder> cells;
    for (int step = 0; step < 40; ++step) {
      add_or_remove(cells, engine);
      const BrickSet all(std::vector<VoxelIndex>(cells.begin(), cells.end()));
      const VoidClusters voids = tracker.update(all, kTenCm);
      std::set<VoxelIndex, RasterOrder> addresses;
      std::transform(cells.begin(), cells.end(), std::inserter(addresses, addresses.end()), tile_of);
      std::size_t first = 0;
      for (const VoxelIndex& address : addresses) {
        std::vector<VoxelIndex> in_tile;
        std::copy_if(cells.begin(), cells.end(), std::back_inserter(in_tile),
                     [&](const VoxelIndex& cell) { return tile_of(cell) == address; });
        const VoidClusters alone = cluster_void_cells(in_tile, kTenCm, options);
        for (const VoxelIndex& cell : in_tile) {
          ASSERT_EQ(voids.number_at(cell), first + alone.number_at(cell)) << "world " << world << ", step " << step;
        }
        for (std::size_t i = 0; i < alone.clusters().size(); ++i) {
          ASSERT_EQ(voids.clusters()[first + i].start, alone.clusters()[i].start);
          ASSERT_EQ(voids.clusters()[first + i].size, alone.clusters()[i].size);
        }
        first += alone.clusters().size();
      }
      ASSERT_EQ(voids.clusters().size(), first);
      std::vector<VoxelIndex> visited;
      voids.for_each_cell([&](const VoxelIndex& cell) { visited.push_back(cell); });
      std::sort(visited.begin(), visited.end(), RasterOrder{});
      ASSERT_TRUE(std::equal(visited.begin(), visited.end(), cells.begin(), cells.end()));
      std::uniform_int_distribution<std::int32_t> at(-130, 130);
      for (int i = 0; i < 100; ++i) {
        const VoxelIndex cell{at(engine), at(engine), at(engine)};
        ASSERT_EQ(voids.number_at(cell) == VoidClusters::kNone, cells.count(cell) == 0);
      }
      clusters += first;
      tiles += addresses.size();
    }
  }
  EXPECT_GT(clusters, 2'000U);
  EXPECT_GT(tiles, 500U);
}

TEST(VoidClusterTracker, KeepsNothingOfCellsOfAnotherSize) {
  const BrickSet cells(std::vector<VoxelIndex>{{0, 0, 0}, {1, 0, 0}});
  VoidClusterTracker tracker;
  EXPECT_NEAR(tracker.update(cells, kTenCm).clusters().front().ellipsoid.centre_m.x(), 0.1, 1e-9);
  EXPECT_NEAR(tracker.update(cells, VoxelFrame{0.2}).clusters().front().ellipsoid.centre_m.x(), 0.2, 1e-9);
}

TEST(VoidClusterTracker, OfNothingThereAreNone) {
  VoidClusterTracker tracker({.min_score = 0.0});
  EXPECT_TRUE(tracker.update({}, kTenCm).clusters().empty());
  const BrickSet one(std::vector<VoxelIndex>{{}});
  EXPECT_THROW((void)tracker.update(one, kTenCm), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
