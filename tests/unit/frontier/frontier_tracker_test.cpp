// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vantage/frontier/frontier_tracker.hpp>
#include <vantage/geometry/raster_order.hpp>

#include "support/sanitized.hpp"

namespace vantage {
namespace {

constexpr std::int32_t kExtent = 26;

OccupancyMap empty_map(bool with_region) {
  OccupancyMapOptions options{.resolution_m = 0.1};
  if (with_region) {
    options.region = Box{{-1.35, -0.85, -2.0}, {1.2, 1.45, 0.95}};
  }
  return OccupancyMap(options);
}

// Random changes: boxes become free, occupied or unknown, bricks are assigned, and scans are inserted.
void change(OccupancyMap& map, std::mt19937& engine) {
  std::uniform_int_distribution<std::int32_t> coordinate(-kExtent, kExtent);
  std::uniform_int_distribution<std::int32_t> extent(1, 14);
  const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
  const VoxelBox box{lo, lo + VoxelIndex{extent(engine), extent(engine), extent(engine)}};
  const std::size_t kind = engine() % 7;
  if (kind == 0) {
    Scan scan;
    scan.world_from_sensor = pose_looking(map.frame().centre_of(lo), 0.0);
    scan.max_range_m = 3.0;
    std::normal_distribution<float> metre(0.0F, 1.2F);
    for (int i = 0; i < 150; ++i) {
      scan.points.emplace_back(metre(engine), metre(engine), metre(engine));
    }
    map.insert(scan);
    return;
  }
  if (kind == 6) {
    const std::uint64_t known = std::uint64_t{engine()} << 32U | engine();
    const std::uint64_t occupied = known & std::uint64_t{engine()} << 28U;
    map.assign(Brick::of_cell(lo), {known, known, 0, known, ~std::uint64_t{0}, known, 0, known},
               {occupied, 0, 0, occupied, 0, occupied, 0, 0});
    return;
  }
  const Occupancy state = kind < 4 ? Occupancy::Free : kind == 4 ? Occupancy::Occupied : Occupancy::Unknown;
  for_each_cell(box, [&](const VoxelIndex& cell) { map.set(cell, state); });
}

// Compares with full extraction and clustering after each of many changes.
TEST(FrontierTracker, HoldsWhatExtractionFromNothingFinds) {
  std::mt19937 engine(11);
  constexpr int kWorlds = test::kSanitized ? 12 : 42;
  std::size_t compared = 0;
  std::size_t cells = 0;
  std::size_t fell_apart = 0;
  std::size_t grew_together = 0;
  for (int world = 0; world < kWorlds; ++world) {
    OccupancyMap map = empty_map(world % 3 == 2);
    const auto connectivity = static_cast<Connectivity>(world % 3);
    FrontierTracker tracker(map, connectivity);
    EXPECT_EQ(tracker.cell_count(), 0U);
    for (int step = 0; step < 25; ++step) {
      const std::size_t before = tracker.cluster_count();
      for (std::size_t changes = 0; changes <= engine() % 3; ++changes) {
        change(map, engine);
      }
      tracker.update();
      const std::vector<VoxelIndex> expected = frontier_cells(map);
      ASSERT_EQ(tracker.cells(), expected) << "world " << world << ", step " << step;
      ASSERT_EQ(tracker.cell_count(), expected.size());
      const auto clusters = frontier_clusters(expected, connectivity);
      ASSERT_EQ(tracker.clusters(), clusters) << "world " << world << ", step " << step;
      ASSERT_EQ(tracker.cluster_count(), clusters.size());
      ++compared;
      cells += expected.size();
      fell_apart += clusters.size() > before ? 1U : 0U;
      grew_together += clusters.size() < before ? 1U : 0U;
    }
    EXPECT_EQ(tracker.update(), 0U) << "nothing has changed";
  }
  EXPECT_EQ(compared, 25U * kWorlds);
  EXPECT_GT(cells, 16'000U * kWorlds);
  EXPECT_GT(fell_apart, 4U * kWorlds);
  EXPECT_GT(grew_together, 1U * kWorlds);
}

TEST(FrontierTracker, KnowsTheClusterOfEveryCell) {
  std::mt19937 engine(12);
  std::size_t compared = 0;
  for (int world = 0; world < 20; ++world) {
    OccupancyMap map = empty_map(false);
    FrontierTracker tracker(map);
    for (int step = 0; step < 10; ++step) {
      change(map, engine);
      tracker.update();
    }
    std::map<VoxelIndex, std::size_t, RasterOrder> size;
    for (const auto& cluster : tracker.clusters()) {
      for (const VoxelIndex& cell : cluster) {
        size[cell] = cluster.size();
      }
    }
    for_each_cell({{-30, -30, -30}, {30, 30, 30}}, [&](const VoxelIndex& cell) {
      const auto found = size.find(cell);
      ASSERT_EQ(tracker.cluster_size(cell), found == size.end() ? 0U : found->second);
      ASSERT_EQ(tracker.contains(cell), found != size.end());
      ++compared;
    });
  }
  EXPECT_EQ(compared, 20U * 60 * 60 * 60);
}

// A tracker of a copy, and one that starts late, find the same.
TEST(FrontierTracker, DoesNotDependOnTheWayTheMapCame) {
  std::mt19937 engine(13);
  OccupancyMap map = empty_map(false);
  FrontierTracker early(map);
  FrontierTracker copy = early;
  for (int step = 0; step < 40; ++step) {
    change(map, engine);
    early.update();
    if (step % 7 == 0) {
      copy.update();
    }
  }
  copy.update();
  EXPECT_EQ(copy.clusters(), early.clusters());
  EXPECT_EQ(FrontierTracker(map).clusters(), early.clusters());
  EXPECT_GT(early.cluster_count(), 1U);
}

// The work of an update follows the change, not the size of the map.
TEST(FrontierTracker, OneCellConcernsAtMostSevenBricks) {
  OccupancyMap map({.resolution_m = 0.1});
  map.assume_free({{-5, -5, -2}, {5, 5, 2}});
  FrontierTracker tracker(map);
  EXPECT_GT(tracker.cell_count(), 20'000U);
  std::mt19937 engine(14);
  std::uniform_int_distribution<std::int32_t> coordinate(-60, 60);
  std::size_t changed = 0;
  for (int i = 0; i < 500; ++i) {
    map.set({coordinate(engine), coordinate(engine), coordinate(engine)}, static_cast<Occupancy>(i % 3));
    const std::size_t bricks = tracker.update();
    EXPECT_LE(bricks, 7U);
    changed += bricks;
  }
  EXPECT_GT(changed, 150U);
  EXPECT_EQ(tracker.clusters(), frontier_clusters(frontier_cells(map)));
}

}  // namespace
}  // namespace vantage
