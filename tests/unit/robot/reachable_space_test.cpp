// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/reachable_space.hpp>

#include "support/changing_map.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

// Two outliers make the bounding box a thousand times as large as the room, but not the reachable space.
TEST(ReachableSpace, CostsNothingForTheBoxAroundTheKnown) {
  OccupancyMap map({.resolution_m = 0.1});
  map.set_log_odds(VoxelBox{{0, 0, 0}, {20, 20, 20}}, -2.0);
  map.set({100'000'000, 0, 5}, Occupancy::Free);
  map.set({-7, 900'000'000, -900'000'000}, Occupancy::Occupied);
  const FreeFlyer flyer({.radius_m = 0.15});
  const ReachableSpace space(map, flyer, pose_looking({1.0, 1.0, 1.0}, 0.0));
  EXPECT_EQ(space.size(), 18U * 18U * 18U);
}

/// Flood fill that asks the platform cell by cell.
std::set<VoxelIndex> flooded(const OccupancyMap& map, const Platform& platform, const VoxelIndex& start) {
  std::vector<VoxelIndex> cells{start};
  std::set<VoxelIndex> met{start};
  for (std::size_t next = 0; next < cells.size(); ++next) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex cell = cells[next] + step;
      if (platform.admits_cell(map, cell) && met.insert(cell).second) {
        cells.push_back(cell);
      }
    }
  }
  return met;
}

std::set<VoxelIndex> cells_of(const ReachableSpace& space) {
  const std::vector<VoxelIndex> cells = space.cells();
  return {cells.begin(), cells.end()};
}

/// Checks all queries of a space against the list of its cells.
void expect_consistent(const ReachableSpace& space, std::mt19937& engine) {
  const std::vector<VoxelIndex> cells = space.cells();
  ASSERT_EQ(cells.size(), space.size());
  for (std::size_t i = 0; i < cells.size(); i += 7) {
    ASSERT_EQ(space.cell(i), cells[i]);
    ASSERT_TRUE(space.contains(cells[i]));
  }
  for (int box = 0; box < 5; ++box) {
    const auto coordinate = [&] { return static_cast<std::int32_t>(engine() % 60) - 22; };
    const VoxelIndex lo{coordinate(), coordinate(), coordinate()};
    const VoxelBox inside{lo, lo + VoxelIndex{1 + coordinate() / 4, 3, 1 + static_cast<std::int32_t>(engine() % 19)}};
    ASSERT_EQ(space.any_in(inside),
              std::any_of(cells.begin(), cells.end(), [&](const VoxelIndex& cell) { return inside.contains(cell); }));
  }
}

using Bricks = std::map<VoxelIndex, BrickPlane, RasterOrder>;

Bricks bricks_of(const ReachableSpace& space) {
  Bricks bricks;
  space.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& cells) { bricks[brick] = cells; });
  return bricks;
}

/// What a user that only looks at the changed bricks knows of a space.
class Mirror {
 public:
  void follow(const ReachableSpace& space) {
    if (space.started_anew()) {
      bricks_.clear();
    }
    for (const VoxelIndex& brick : space.changed()) {
      bricks_[brick] = *space.find(brick);
    }
    std::erase_if(bricks_, [](const auto& brick) { return brick.second == BrickPlane{}; });
  }
  [[nodiscard]] const Bricks& bricks() const { return bricks_; }

 private:
  Bricks bricks_;
};

// Compares with a flood fill and with a new object after every few of thousands of changes. The robot moves about,
// the map is copied, and the platform changes; walls are closed and opened far from the robot.
TEST(ReachableSpace, IsWhatAFloodFillReachesWhateverHappensToTheMap) {
  std::mt19937 engine(31);
  std::size_t compared = 0;
  std::size_t cut_off = 0;
  std::size_t nowhere = 0;
  std::size_t flooded_too = 0;
  constexpr int kWorlds = test::kSanitized ? 3 : 8;
  for (int world = 0; world < kWorlds; ++world) {
    OccupancyMap map({.resolution_m = 0.1});
    const FreeFlyer slim({.radius_m = 0.07 * (world % 3),
                          .min_height_m = -0.5,
                          .margin_m = world % 2 == 0 ? std::optional(0.0) : std::nullopt});
    const FreeFlyer wide({.radius_m = 0.17});
    ReachableSpace followed;
    Mirror mirror;
    for (int step = 0; step < 400; ++step) {
      change_around_origin(map, engine);
      if (step % 20 == 7) {  // a wall across all, which a later step removes
        const std::int32_t x = static_cast<std::int32_t>(engine() % 30) - 10;
        map.set_log_odds(VoxelBox{{x, -20, -20}, {x + 1, 40, 40}}, step % 40 == 7 ? 3.0 : -2.0);
      }
      if (step == 250) {
        map = OccupancyMap(map);
      }
      if (engine() % 4 != 0) {
        continue;
      }
      const Platform& platform = step / 150 == 1 ? static_cast<const Platform&>(wide) : slim;
      const auto along = [&] { return 0.05 + 0.1 * static_cast<double>(engine() % 28) - 0.9; };
      const Pose pose = pose_looking({along(), along(), along()}, 0.0);  // a cell's centre
      followed.follow(map, platform, pose);
      mirror.follow(followed);
      const ReachableSpace fresh(map, platform, pose);
      ASSERT_EQ(followed.start(), fresh.start());
      ASSERT_EQ(followed.only_turns(), fresh.only_turns());
      ASSERT_EQ(followed.cells(), fresh.cells());
      const std::set<VoxelIndex> cells = cells_of(followed);
      ASSERT_EQ(mirror.bricks(), bricks_of(followed));
      ASSERT_NO_FATAL_FAILURE(expect_consistent(followed, engine));
      if (!followed.start()) {
        ASSERT_TRUE(cells.empty());
        ++nowhere;
        continue;
      }
      if (engine() % 5 == 0) {
        ASSERT_EQ(cells, flooded(map, platform, *followed.start()));
        ++flooded_too;
      }
      cut_off += cells.size() < followed.admitted().cells().size() ? 1U : 0U;
      ++compared;
    }
  }
  EXPECT_GT(compared, 25U * kWorlds);
  EXPECT_GT(cut_off, 5U * kWorlds);
  EXPECT_GT(nowhere, 1U * kWorlds);
  EXPECT_GT(flooded_too, 3U * kWorlds);
}

// A body between eight free cells fits, but at the centre of none of them.
TEST(ReachableSpace, IsOneCellWhereTheBodyCanOnlyTurn) {
  const FreeFlyer flyer({.radius_m = 0.08, .margin_m = 0.0});
  OccupancyMap map({.resolution_m = 0.1});
  const Pose between = pose_looking({0.1, 0.1, 0.1}, 0.0);
  ReachableSpace space;
  Mirror mirror;
  for (int round = 0; round < 4; ++round) {
    map.set_log_odds(VoxelBox{{-9, -9, -9}, {12, 12, 12}}, round % 2 == 0 ? 3.0 : -2.0);
    map.set_log_odds(VoxelBox{{0, 0, 0}, {2, 2, 2}}, -2.0);
    space.follow(map, flyer, between);
    mirror.follow(space);
    EXPECT_EQ(space.only_turns(), round % 2 == 0);
    EXPECT_EQ(space.size(), round % 2 == 0 ? 1U : 19U * 19U * 19U);
    EXPECT_EQ(mirror.bricks(), bricks_of(space));
    EXPECT_TRUE(space.contains(*space.start()));
  }
  EXPECT_EQ(space.position_in({5, 5, 5}), map.frame().centre_of({5, 5, 5}));
}

// Cells that touch at corners only are many parts of a brick, and a snake is one part that is entered many times.
TEST(ReachableSpace, FollowsACheckerboardAndASnake) {
  const FreeFlyer point({.radius_m = 0.0, .margin_m = 0.0});
  OccupancyMap map({.resolution_m = 0.1});
  for_each_cell({{0, 0, 0}, {40, 40, 24}}, [&](const VoxelIndex& cell) {
    map.set(cell, (cell.x + cell.y + cell.z) % 2 == 0 ? Occupancy::Free : Occupancy::Occupied);
  });
  const Pose pose = pose_looking({0.05, 0.05, 0.05}, 0.0);
  ReachableSpace space;
  space.follow(map, point, pose);
  EXPECT_EQ(space.size(), 1U);
  for_each_cell({{0, 0, 0}, {40, 40, 1}}, [&](const VoxelIndex& cell) {
    const bool in_row = cell.y % 2 == 0;
    const bool at_turn = cell.x == (cell.y % 4 == 1 ? 39 : 0);
    map.set(cell, in_row || at_turn ? Occupancy::Free : Occupancy::Occupied);
  });
  space.follow(map, point, pose);
  EXPECT_EQ(cells_of(space), flooded(map, point, {0, 0, 0}));
  EXPECT_GT(space.size(), 800U);
  map.set({39, 1, 0}, Occupancy::Occupied);  // cuts the snake after its first row, as far as its layer goes
  map.set_log_odds(VoxelBox{{0, 0, 1}, {40, 40, 2}}, 3.0);
  space.follow(map, point, pose);
  EXPECT_EQ(space.size(), 40U);
}

}  // namespace
}  // namespace vantage
