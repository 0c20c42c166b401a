// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/map/brick_set.hpp>

#include "support/qhull.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

constexpr std::int32_t kHalfExtent = 20;

// Random changes: scans from increasing distances, cells at the border of the occupied ones become free, boxes become
// free or unknown.
void change(OccupancyMap& map, int step, std::mt19937& engine) {
  std::uniform_int_distribution<std::int32_t> coordinate(-kHalfExtent, kHalfExtent);
  const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
  const std::size_t kind = engine() % 8;
  if (kind < 5) {
    Scan scan;
    scan.world_from_sensor = pose_looking(map.frame().centre_of(lo), 0.0);
    scan.max_range_m = 3.0;
    std::normal_distribution<float> metre(0.0F, 0.03F * static_cast<float>(step) + 1e-6F);
    for (int i = 0; i < 40; ++i) {
      scan.points.emplace_back(metre(engine), metre(engine), metre(engine));
    }
    map.insert(scan);
  } else if (kind == 5) {
    const test::QhullHull hull = test::qhull_of_occupied(map);
    if (!hull.empty()) {
      map.set(hull.corners()[engine() % hull.corners().size()], Occupancy::Free);
    }
  } else {
    const auto edge = static_cast<std::int32_t>(1 + engine() % 14);
    for_each_cell({lo, lo + VoxelIndex{edge, edge, edge}},
                  [&](const VoxelIndex& cell) { map.set(cell, static_cast<Occupancy>(kind == 6 ? 0 : 1)); });
  }
}

// Compares with full extraction after each of many changes.
TEST(VoidTracker, HoldsWhatExtractionFromNothingFinds) {
  std::mt19937 engine(71);
  std::size_t compared = 0;
  std::size_t cells = 0;
  std::size_t hulls_kept = 0;
  std::size_t hulls_grown = 0;
  std::size_t hulls_shrunk = 0;
  for (int world = 0; world < 10; ++world) {
    OccupancyMapOptions options{.resolution_m = 0.1};
    if (world % 3 == 2) {
      options.region = Box{{-1.35, -1.85, -2.0}, {2.2, 1.45, 1.95}};
    }
    OccupancyMap map(options);
    VoidTracker tracker(map);
    EXPECT_EQ(tracker.cell_count(), 0U);
    for (int step = 0; step < 30; ++step) {
      const LatticeHull before = tracker.hull();
      change(map, step, engine);
      const bool hull_changed = tracker.update();
      const std::vector<VoxelIndex> expected = void_cells(map);
      ASSERT_EQ(tracker.cells(), expected) << "world " << world << ", step " << step;
      ASSERT_EQ(tracker.cell_count(), expected.size());
      const test::QhullHull expected_hull = test::qhull_of_occupied(map);
      for (const VoxelIndex& corner : expected_hull.corners()) {
        ASSERT_TRUE(tracker.hull().contains(corner));
      }
      hulls_kept += !hull_changed && !before.empty() ? 1U : 0U;
      const std::vector<VoxelIndex> corners = tracker.hull().corners();
      const std::vector<VoxelIndex> corners_before = before.corners();
      const bool shrunk = std::any_of(corners_before.begin(), corners_before.end(),
                                      [&](auto& corner) { return !tracker.hull().contains(corner); });
      hulls_shrunk += shrunk ? 1U : 0U;
      hulls_grown += !shrunk && std::any_of(corners.begin(), corners.end(),
                                            [&](auto& corner) { return !before.contains(corner); })
                         ? 1U
                         : 0U;
      ++compared;
      cells += expected.size();
    }
    EXPECT_FALSE(tracker.update()) << "nothing has changed";
  }
  EXPECT_EQ(compared, 10U * 30U);
  EXPECT_GT(cells, 1'000'000U);
  EXPECT_GT(hulls_kept, 50U);
  EXPECT_GT(hulls_grown, 50U);
  EXPECT_GT(hulls_shrunk, 10U);
}

const std::array<VoxelBox, 1> kEverywhere{VoxelBox{{-1000, -1000, -1000}, {1000, 1000, 1000}}};

VoxelBox random_box(std::mt19937& engine) {
  std::uniform_int_distribution<std::int32_t> anywhere(-20, 20);
  const VoxelIndex lo{anywhere(engine), anywhere(engine), anywhere(engine)};
  return {lo, lo + VoxelIndex{3, 3, 3}};
}

// The tiles that hold a cell of a box.
std::set<VoxelIndex> tiles_of(const std::vector<VoxelBox>& boxes) {
  std::set<VoxelIndex> tiles;
  for (const VoxelBox& box : boxes) {
    for_each_cell(box, [&](const VoxelIndex& cell) { tiles.insert({cell.x >> 6, cell.y >> 6, cell.z >> 6}); });
  }
  return tiles;
}

// Compares with a flood through void cells, one by one.
TEST(VoidTracker, KnowsTheVoidCellsBehindAFrontier) {
  std::mt19937 engine(73);
  std::size_t behind_count = 0;
  std::size_t near_count = 0;
  std::size_t enclosed = 0;
  constexpr int kWorlds = test::kSanitized ? 2 : 3;
  for (int world = 0; world < kWorlds; ++world) {
    OccupancyMap map({.resolution_m = 0.1});
    VoidTracker tracker(map);
    for (int step = 0; step < 25; ++step) {
      change(map, step, engine);
      tracker.update();
      std::vector<VoxelIndex> frontier = frontier_cells(map);
      std::erase_if(frontier, [&](const VoxelIndex&) { return step % 3 == 0 && engine() % 8 != 0; });
      std::vector<VoxelIndex> expected;
      std::set<VoxelIndex> met;
      const auto meet_beside = [&](const VoxelIndex& cell) {
        for (const VoxelIndex& by : kFaceNeighbours) {
          if (tracker.contains(cell + by) && met.insert(cell + by).second) {
            expected.push_back(cell + by);
          }
        }
      };
      std::for_each(frontier.begin(), frontier.end(), meet_beside);
      for (std::size_t next = 0; next < expected.size(); ++next) {
        meet_beside(VoxelIndex(expected[next]));
      }
      std::vector<VoxelIndex> behind = tracker.cells_behind(frontier, kEverywhere).cells();
      std::sort(behind.begin(), behind.end());
      ASSERT_EQ(behind, std::vector<VoxelIndex>(met.begin(), met.end())) << "world " << world << ", step " << step;
      behind_count += behind.size();
      enclosed += tracker.cell_count() - behind.size();
      const std::vector<VoxelBox> near{random_box(engine)};
      const std::set<VoxelIndex> tiles = tiles_of(near);
      std::erase_if(met, [&](const VoxelIndex& cell) {
        return tiles.count({cell.x >> 6, cell.y >> 6, cell.z >> 6}) == 0;
      });
      behind = tracker.cells_behind(frontier, near).cells();
      std::sort(behind.begin(), behind.end());
      ASSERT_EQ(behind, std::vector<VoxelIndex>(met.begin(), met.end())) << "world " << world << ", step " << step;
      near_count += behind.size();
    }
  }
  EXPECT_GT(behind_count, 15'000U * kWorlds);
  EXPECT_GT(near_count, 1'000U * kWorlds);
  EXPECT_LT(near_count, behind_count * 3 / 4);
  EXPECT_GT(enclosed, 100U * kWorlds);
}

// Parts of a map lie far apart, so that most of the hull between them is not stored. Parts are added, corners of the
// hull removed, and boxes in between become known and unknown again.
TEST(VoidTracker, FindsWhatLiesBetweenPartsFarApart) {
  std::mt19937 engine(79);
  std::uniform_int_distribution<std::int32_t> far(-150, 150);
  std::uniform_int_distribution<std::int32_t> high(-20, 20);
  std::size_t compared = 0;
  std::size_t between = 0;  // void cells outside the bricks of the map
  std::size_t behind_count = 0;
  for (int world = 0; world < 3; ++world) {
    OccupancyMap map({.resolution_m = 0.1});
    VoidTracker tracker(map);
    for (int step = 0; step < 25; ++step) {
      const VoxelIndex lo{far(engine), far(engine), high(engine)};
      const std::vector<VoxelIndex> corners = tracker.hull().corners();
      if (step % 5 == 4 && !corners.empty()) {
        map.set(corners[engine() % corners.size()], Occupancy::Free);
      } else {
        for_each_cell({lo, lo + VoxelIndex{6, 6, 6}}, [&](const VoxelIndex& cell) {
          map.set(cell, step % 5 < 2 ? Occupancy::Occupied : step % 5 == 2 ? Occupancy::Free : Occupancy::Unknown);
        });
      }
      tracker.update();
      const std::vector<VoxelIndex> expected = void_cells(map);
      ASSERT_EQ(tracker.cell_count(), expected.size()) << "world " << world << ", step " << step;
      ASSERT_EQ(count_void_cells(map), expected.size());
      ASSERT_TRUE(tracker.cells() == expected);
      BrickSet left;
      for (const VoxelIndex& cell : expected) {
        between += map.find_brick(Brick::of_cell(cell)) == nullptr ? 1U : 0U;
        left.insert(cell);
      }
      for (int i = 0; i < 200; ++i) {
        const VoxelIndex cell{far(engine), far(engine), high(engine)};
        ASSERT_EQ(tracker.contains(cell), left.contains(cell));
      }
      if (step % 3 == 0) {
        const std::vector<VoxelIndex> frontier = frontier_cells(map);
        std::vector<VoxelIndex> reached;
        const auto reach_beside = [&](const VoxelIndex& cell) {
          for (const VoxelIndex& by : kFaceNeighbours) {
            if (left.contains(cell + by)) {
              const std::size_t offset = Brick::offset_of(cell + by);
              left.plane(Brick::of_cell(cell + by))[offset >> 6U] &= ~(std::uint64_t{1} << (offset & 63U));
              reached.push_back(cell + by);
            }
          }
        };
        std::for_each(frontier.begin(), frontier.end(), reach_beside);
        for (std::size_t next = 0; next < reached.size(); ++next) {
          reach_beside(VoxelIndex(reached[next]));
        }
        std::vector<VoxelIndex> behind = tracker.cells_behind(frontier, kEverywhere).cells();
        std::sort(behind.begin(), behind.end());
        std::sort(reached.begin(), reached.end());
        ASSERT_TRUE(behind == reached) << "world " << world << ", step " << step;
        behind_count += behind.size();
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3U * 25U);
  EXPECT_GT(between, 10'000'000U);
  EXPECT_GT(behind_count, 1'000'000U);
}

// A plane has no volume, whatever becomes known in it.
TEST(VoidTracker, AMapOfOneLayerNeverHasAHull) {
  OccupancyMap map({.resolution_m = 0.1, .region = Box{{-2.0, -2.0, 0.0}, {2.0, 2.0, 0.1}}});
  VoidTracker tracker(map);
  std::mt19937 engine(5);
  std::uniform_int_distribution<std::int32_t> at(-20, 19);
  for (int i = 0; i < 60; ++i) {
    map.set({at(engine), at(engine), 0}, i % 3 == 0 ? Occupancy::Free : Occupancy::Occupied);
    EXPECT_FALSE(tracker.update()) << "there is nothing to change";
    ASSERT_TRUE(tracker.hull().empty());
    ASSERT_EQ(tracker.cell_count(), void_cells(map).size());
  }
}

// Points, lines and planes of occupied cells have no volume until a cell is added beside them, and again after it is
// removed.
TEST(VoidTracker, KeepsUpWithCloudsWithoutVolume) {
  OccupancyMap map({.resolution_m = 0.1});
  VoidTracker tracker(map);
  for (std::int32_t i = 0; i < 40; ++i) {
    map.set({i % 8, i / 8 * 3, 5}, Occupancy::Occupied);
    tracker.update();
    ASSERT_TRUE(tracker.hull().empty());
    ASSERT_EQ(tracker.cell_count(), 0U);
  }
  map.set({3, 3, 17}, Occupancy::Occupied);
  EXPECT_TRUE(tracker.update());
  EXPECT_GT(tracker.cell_count(), 100U);
  EXPECT_EQ(tracker.cells(), void_cells(map));
  map.set({3, 3, 17}, Occupancy::Free);
  EXPECT_TRUE(tracker.update());
  EXPECT_EQ(tracker.cell_count(), 0U);
  map.set({3, 3, -9}, Occupancy::Occupied);
  EXPECT_TRUE(tracker.update());
  EXPECT_EQ(tracker.cells(), void_cells(map));
  EXPECT_TRUE(tracker.contains({3, 3, 0}));
  EXPECT_FALSE(tracker.contains({3, 3, 10}));
}

}  // namespace
}  // namespace vantage
