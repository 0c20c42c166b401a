// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vantage/geometry/raster_order.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/robot/reachable_space.hpp>

#include "support/sanitized.hpp"

namespace vantage {
namespace {

constexpr double kCell = 0.1;

/// A block of free cells in which random single cells are occupied, contested or unknown.
OccupancyMap random_map(std::mt19937& engine, std::int32_t side, double blocked_share) {
  OccupancyMap map({.resolution_m = kCell});
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for_each_cell({{0, 0, 0}, {side, side, side}}, [&](const VoxelIndex& cell) {
    const double draw = share(engine);
    if (draw > blocked_share) {
      map.set(cell, Occupancy::Free);
    } else if (draw > 0.6 * blocked_share) {
      map.set(cell, Occupancy::Occupied);
    } else if (draw > 0.3 * blocked_share) {
      map.set_log_odds(cell, 0.85 - 3 * 0.4);  // hit once, missed three times: contested
    }
  });
  return map;
}

/// By definition: all cells whose box is closer than the radius are clear.
bool sphere_is_free(const OccupancyMap& map, const Eigen::Vector3d& centre, double radius_m) {
  const VoxelIndex home = map.frame().cell_of(centre);
  bool free = true;
  for_each_cell(VoxelBox{home, home + VoxelIndex{1, 1, 1}}.grown(5), [&](const VoxelIndex& cell) {
    if (cell == home || map.frame().box_of(cell).distance_to(centre) < radius_m - 1e-9) {
      free = free && map.at(cell) == Occupancy::Free && !map.contested(cell);
    }
  });
  return free;
}

TEST(FreeFlyer, AdmitsExactlyWhereItsSphereTouchesFreeCellsOnly) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> metre(0.0, 1.6);
  std::size_t admitted = 0;
  std::size_t refused = 0;
  for (const double radius_m : {0.0, 0.04, 0.1, 0.23}) {
    const FreeFlyer flyer({.radius_m = radius_m, .margin_m = 0.0});
    const OccupancyMap map = random_map(engine, 16, 0.02);
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d position(metre(engine), metre(engine), metre(engine));
      const bool expected = sphere_is_free(map, position, radius_m);
      ASSERT_EQ(flyer.admits(map, pose_looking(position, 1.0)), expected) << radius_m;
      ++(expected ? admitted : refused);
    }
  }
  EXPECT_GT(admitted, 2000U);
  EXPECT_GT(refused, 2000U);
}

TEST(FreeFlyer, KnowsAllAdmittedCellsAtOnceAsItKnowsEach) {
  std::mt19937 engine(2);
  std::size_t compared = 0;
  std::size_t admitted_count = 0;
  for (const double radius_m : {0.0, 0.05, 0.15, 0.2, 0.28}) {
    const FreeFlyer flyer({.radius_m = radius_m, .min_height_m = 0.3, .max_height_m = 1.2});
    const OccupancyMap map = random_map(engine, 16, 0.01);
    const VoxelBox box = map.bounds().grown(2);
    const VoxelGrid<std::uint8_t> admitted = flyer.admitted_cells(map, box);
    for_each_cell(box, [&](const VoxelIndex& cell) {
      ASSERT_EQ(admitted[cell] != 0, flyer.admits_cell(map, cell)) << radius_m;
      ++compared;
      admitted_count += admitted[cell];
    });
  }
  EXPECT_EQ(compared, 5U * 20U * 20U * 20U);
  EXPECT_GT(admitted_count, 1000U);
}

// Without a margin a body keeps at least a cell of the map clear, as one of that radius with a margin of 0 does.
TEST(FreeFlyer, KeepsAtLeastACellClear) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> metre(0.0, 1.6);
  std::size_t admitted = 0;
  std::size_t moved = 0;
  std::size_t tighter = 0;
  for (const double radius_m : {0.0, 0.04, 0.1, 0.17}) {
    const OccupancyMap map = random_map(engine, 16, 0.02);
    const double clear_m = std::max(radius_m, kCell);
    const FreeFlyer flyer({.radius_m = radius_m});
    const FreeFlyer exact_flyer({.radius_m = clear_m, .margin_m = 0.0});
    const FreeFlyer close_flyer({.radius_m = radius_m, .margin_m = 0.0});
    const GroundRobot robot({.radius_m = radius_m});
    const GroundRobot exact_robot({.radius_m = clear_m, .margin_m = 0.0});
    EXPECT_EQ(flyer.admitted_cells(map, map.bounds()).values(),
              exact_flyer.admitted_cells(map, map.bounds()).values());
    EXPECT_EQ(robot.admitted_cells(map, map.bounds()).values(),
              exact_robot.admitted_cells(map, map.bounds()).values());
    for (int i = 0; i < 2000; ++i) {
      const Pose from = pose_looking({metre(engine), metre(engine), metre(engine)}, 1.0);
      Pose to = from;
      to.translation() += Eigen::Vector3d(metre(engine), metre(engine), 0.0) * 0.3;
      const VoxelIndex cell = map.frame().cell_of(from.translation());
      EXPECT_EQ(flyer.admits(map, from), exact_flyer.admits(map, from));
      EXPECT_EQ(flyer.admits_cell(map, cell), exact_flyer.admits_cell(map, cell));
      EXPECT_EQ(flyer.admits_motion(map, from, to), exact_flyer.admits_motion(map, from, to));
      EXPECT_EQ(robot.admits(map, from), exact_robot.admits(map, from));
      EXPECT_EQ(robot.admits_motion(map, from, to), exact_robot.admits_motion(map, from, to));
      admitted += flyer.admits(map, from) ? 1U : 0U;
      moved += flyer.admits_motion(map, from, to) ? 1U : 0U;
      tighter += close_flyer.admits(map, from) && !flyer.admits(map, from) ? 1U : 0U;
    }
  }
  EXPECT_GT(admitted, 500U);
  EXPECT_GT(moved, 200U);
  EXPECT_GT(tighter, 200U);
}

TEST(FreeFlyer, AMotionIsAdmittedExactlyWhenEveryPoseOfItIs) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> metre(0.2, 1.4);
  std::size_t admitted = 0;
  std::size_t refused = 0;
  for (const double radius_m : {0.03, 0.12}) {
    const FreeFlyer flyer({.radius_m = radius_m, .margin_m = 0.0});
    const FreeFlyer fatter({.radius_m = radius_m + 2e-3, .margin_m = 0.0});
    const OccupancyMap map = random_map(engine, 16, 0.01);
    for (int i = 0; i < 2000; ++i) {
      const Pose from = pose_looking({metre(engine), metre(engine), metre(engine)}, 0.0);
      const Pose to = pose_looking({metre(engine), metre(engine), metre(engine)}, 0.0);
      if (!flyer.admits(map, from)) {
        continue;
      }
      bool all = true;
      bool all_fatter = true;
      for (int s = 0; s <= 400; ++s) {
        Pose between = from;
        between.translation() += s / 400.0 * (to.translation() - from.translation());
        all = all && flyer.admits(map, between);
        all_fatter = all_fatter && fatter.admits(map, between);
      }
      const bool motion = flyer.admits_motion(map, from, to);
      EXPECT_TRUE(!motion || all) << "an admitted motion passes admitted poses only";
      EXPECT_TRUE(motion || !all_fatter) << "a refused motion passes a refused pose";
      ++(motion ? admitted : refused);
    }
  }
  EXPECT_GT(admitted, 100U);
  EXPECT_GT(refused, 100U);
}

TEST(FreeFlyer, MayLeaveAPlaceFoundTooTightButNotEnterOne) {
  OccupancyMap map({.resolution_m = kCell});
  map.assume_free({{0, 0, 0}, {2, 1, 1}});
  map.set({5, 3, 5}, Occupancy::Occupied);
  const FreeFlyer flyer({.radius_m = 0.2});
  const Pose tight = pose_looking({0.55, 0.55, 0.55}, 0.0);
  const Pose wide = pose_looking({1.5, 0.55, 0.55}, 0.0);
  EXPECT_FALSE(flyer.admits(map, tight));
  EXPECT_TRUE(flyer.admits_motion(map, tight, wide));
  EXPECT_FALSE(flyer.admits_motion(map, wide, tight));
  const auto path = flyer.path(map, tight, wide);
  ASSERT_TRUE(path.has_value());
  EXPECT_TRUE(path->front().isApprox(tight));
  EXPECT_TRUE(path->back().isApprox(wide));
}

TEST(FreeFlyer, AYawOnlyFlyerKeepsLevel) {
  const FreeFlyer flyer({.yaw_only = true});
  const Pose pose = flyer.facing({1, 2, 3}, {1, 1, 5});
  EXPECT_NEAR(optical_axis(pose).z(), 0.0, 1e-12);
  EXPECT_NEAR(optical_axis(pose).x(), optical_axis(pose).y(), 1e-12);
}

TEST(FreeFlyer, NamesTheOptionAtFault) {
  try {
    const FreeFlyer flyer({.radius_m = -0.5});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "FreeFlyerOptions::radius_m is -0.5, must be in [0, 1000]");
  }
  EXPECT_THROW(FreeFlyer({.margin_m = -1}), std::invalid_argument);
  EXPECT_THROW(FreeFlyer({.min_height_m = 2, .max_height_m = 1}), std::invalid_argument);
}

// Length in cells of the shortest path from the start of a space, by relaxing all steps until nothing changes. Steps
// change at most `axes` coordinates, and every cell of the block between their ends is reachable.
double slow_length(const ReachableSpace& space, const VoxelIndex& goal, int axes = 3) {
  const std::vector<VoxelIndex> cells = space.cells();
  std::map<VoxelIndex, double> length;
  for (const VoxelIndex& cell : cells) {
    length[cell] = cell == *space.start() ? 0.0 : 1e9;
  }
  for (bool changes = true; changes;) {
    changes = false;
    for (const VoxelIndex& cell : cells) {
      for (const VoxelIndex& step : kAllNeighbours) {
        const int squares = step.x * step.x + step.y * step.y + step.z * step.z;
        bool fits = squares <= axes;
        for_each_cell({{std::min(step.x, 0), std::min(step.y, 0), std::min(step.z, 0)},
                       {std::max(step.x, 0) + 1, std::max(step.y, 0) + 1, std::max(step.z, 0) + 1}},
                      [&](const VoxelIndex& by) { fits = fits && space.contains(cell + by); });
        if (fits && length[cell] + std::sqrt(squares) < length[cell + step] - 1e-9) {
          length[cell + step] = length[cell] + std::sqrt(squares);
          changes = true;
        }
      }
    }
  }
  return length[goal];
}

TEST(GridPath, IsAsShortAsTheSlowSearchSaysAndKeepsToAdmittedPoses) {
  std::mt19937 engine(4);
  std::size_t ways = 0;
  std::size_t dead_ends = 0;
  std::size_t diagonal = 0;
  constexpr std::size_t kWorlds = test::kSanitized ? 12 : 60;
  for (std::size_t world = 0; world < kWorlds; ++world) {
    const OccupancyMap map = random_map(engine, 12, world % 2 == 0 ? 0.35 : 0.1);
    const FreeFlyer flyer({.radius_m = 0.0, .margin_m = 0.0});
    std::uniform_int_distribution<std::int32_t> coordinate(0, 11);
    const auto draw = [&] {
      VoxelIndex cell;
      do {
        cell = {coordinate(engine), coordinate(engine), coordinate(engine)};
      } while (map.at(cell) != Occupancy::Free);
      return cell;
    };
    const Pose from = pose_looking(map.frame().centre_of(draw()), 0.0);
    const VoxelIndex goal = draw();
    const Pose to = pose_looking(map.frame().centre_of(goal), 1.0);
    const ReachableSpace space(map, flyer, from);
    const auto path = flyer.path(map, from, to);
    ASSERT_EQ(path.has_value(), space.contains(goal));
    if (!path) {
      ++dead_ends;
      continue;
    }
    ++ways;
    const GridPaths paths(space);
    const std::vector<VoxelIndex> goals{goal};
    const auto length = [&](const std::vector<VoxelIndex>& cells) {
      double sum = 0;
      for (std::size_t i = 1; i < cells.size(); ++i) {
        sum += (map.frame().centre_of(cells[i]) - map.frame().centre_of(cells[i - 1])).norm();
      }
      return sum;
    };
    const double expected = slow_length(space, goal) * kCell;
    EXPECT_NEAR(length(paths.to(goal)), expected, 1e-2 * kCell);
    EXPECT_NEAR(length(paths.to_nearest(goals)), expected, 1e-2 * kCell);
    diagonal += slow_length(space, goal, 1) > 1.001 * slow_length(space, goal) ? 1U : 0U;
    for (std::size_t i = 1; i < path->size(); ++i) {
      EXPECT_TRUE(flyer.admits_motion(map, (*path)[i - 1], (*path)[i]));
    }
    EXPECT_TRUE(path->front().isApprox(from));
    EXPECT_TRUE(path->back().isApprox(to));
  }
  EXPECT_GT(ways, kWorlds / 2);
  EXPECT_GT(diagonal, kWorlds / 3);
  EXPECT_EQ(ways + dead_ends, kWorlds);
}

TEST(GridPath, FindsAllGoalsThatAreHardlyFurtherThanTheNearest) {
  std::mt19937 engine(9);
  std::size_t within = 0;
  std::size_t beyond = 0;
  for (int world = 0; world < 30; ++world) {
    const OccupancyMap map = random_map(engine, 12, 0.25);
    VoxelIndex start{0, 0, 0};
    while (map.at(start) != Occupancy::Free) {
      ++start.x;
    }
    const FreeFlyer flyer({.radius_m = 0.0, .margin_m = 0.0});
    const ReachableSpace space(map, flyer, pose_looking(map.frame().centre_of(start), 0.0));
    const GridPaths paths(space);
    std::vector<VoxelIndex> goals{{40, 40, 40}};
    for (int i = 0; i < 12; ++i) {
      goals.push_back(space.cell(engine() % space.size()));
    }
    const auto length_m = [&](const VoxelIndex& goal) {
      const std::vector<VoxelIndex> way = paths.to(goal);
      double sum_m = 0.0;
      for (std::size_t i = 1; i < way.size(); ++i) {
        sum_m += (map.frame().centre_of(way[i]) - map.frame().centre_of(way[i - 1])).norm();
      }
      return sum_m;
    };
    const double nearest_m = length_m(paths.to_nearest(goals).back());
    const double detour_m = 3.3 * kCell;
    const auto [found, met] = paths.nearest_within(goals, detour_m, kCell);
    for (int i = 0; i < 40; ++i) {
      const VoxelIndex cell = space.cell(engine() % space.size());
      EXPECT_TRUE(met.contains(cell) || length_m(cell) > nearest_m + detour_m);
      EXPECT_TRUE(!met.contains(cell) || length_m(cell) <= nearest_m + detour_m + 2.0 * kCell);
    }
    for (std::size_t i = 1; i < goals.size(); ++i) {
      const bool expected = length_m(goals[i]) <= nearest_m + detour_m;
      EXPECT_EQ(std::find(found.begin(), found.end(), goals[i]) != found.end(), expected) << world;
      ++(expected ? within : beyond);
    }
    for (std::size_t i = 1; i < found.size(); ++i) {
      EXPECT_LE(length_m(found[i - 1]), length_m(found[i]) + 1e-2 * kCell);
    }
    const std::set<VoxelIndex, RasterOrder> reachable_goals(goals.begin() + 1, goals.end());
    EXPECT_EQ(paths.nearest_within(goals, 1e9, kCell).goals.size(), reachable_goals.size());
  }
  EXPECT_GT(within, 60U);
  EXPECT_GT(beyond, 60U);
}

// For any body size and any distance between the few known cells.
TEST(FreeFlyer, ABodyLargerThanTheKnownFitsNowhere) {
  std::mt19937 engine(9);
  OccupancyMap map = random_map(engine, 16, 0.0);
  map.set({20000, 20000, 20000}, Occupancy::Free);
  const Pose pose = pose_looking({0.85, 0.85, 0.85}, 0.0);
  for (const double radius_m : {1.2, 100.0, 1000.0}) {
    for (const double margin_m : {0.0, 1000.0}) {
      const FreeFlyer flyer({.radius_m = radius_m, .margin_m = margin_m});
      const GroundRobot robot({.radius_m = radius_m, .margin_m = margin_m});
      for (const Platform* platform : {static_cast<const Platform*>(&flyer), static_cast<const Platform*>(&robot)}) {
        EXPECT_FALSE(platform->admits(map, pose));
        EXPECT_FALSE(platform->admits_cell(map, {8, 8, 8}));
        EXPECT_EQ(ReachableSpace(map, *platform, pose).size(), 0U);
      }
    }
  }
  for (const double radius_m : {1e9, 1000.5, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(FreeFlyer({.radius_m = radius_m}), std::invalid_argument);
    EXPECT_THROW(FreeFlyer({.margin_m = radius_m}), std::invalid_argument);
    EXPECT_THROW(GroundRobot({.radius_m = radius_m}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace vantage
