// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vantage/robot/grid_path.hpp>
#include <vantage/robot/ground_robot.hpp>

namespace vantage {
namespace {

constexpr double kFloorCell = 0.1;
constexpr std::int32_t kLayer = 4;

/// A layer of free cells in which random single cells are blocked.
OccupancyMap random_plane(std::mt19937& engine, std::int32_t side, double blocked_share) {
  OccupancyMap map({.resolution_m = kFloorCell});
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for_each_cell({{0, 0, kLayer}, {side, side, kLayer + 1}}, [&](const VoxelIndex& cell) {
    const double draw = share(engine);
    if (draw > blocked_share) {
      map.set(cell, Occupancy::Free);
    } else if (draw > 0.5 * blocked_share) {
      map.set(cell, Occupancy::Occupied);
    }
  });
  return map;
}

/// By definition: all cells of the layer closer than the radius are clear.
bool disc_is_free(const OccupancyMap& map, const Eigen::Vector3d& centre, double radius_m) {
  const VoxelIndex home = map.frame().cell_of(centre);
  bool free = home.z == kLayer;
  for (std::int32_t y = home.y - 6; y <= home.y + 6; ++y) {
    for (std::int32_t x = home.x - 6; x <= home.x + 6; ++x) {
      const Eigen::Vector3d nearest(std::clamp(centre.x(), x * kFloorCell, (x + 1) * kFloorCell),
                                    std::clamp(centre.y(), y * kFloorCell, (y + 1) * kFloorCell), centre.z());
      if ((x == home.x && y == home.y) || (nearest - centre).norm() < radius_m - 1e-9) {
        free = free && map.at({x, y, kLayer}) == Occupancy::Free;
      }
    }
  }
  return free;
}

TEST(GroundRobot, AdmitsExactlyWhereItsDiscTouchesFreeCellsOnly) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> metre(0.0, 3.2);
  std::size_t admitted = 0;
  std::size_t refused = 0;
  for (const double radius_m : {0.0, 0.04, 0.1, 0.23}) {
    const GroundRobot robot({.radius_m = radius_m, .margin_m = 0.0});
    const OccupancyMap map = random_plane(engine, 32, 0.03);
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d position(metre(engine), metre(engine), (kLayer + 0.3) * kFloorCell);
      const bool expected = disc_is_free(map, position, radius_m);
      ASSERT_EQ(robot.admits(map, pose_looking(position, 1.0)), expected) << radius_m;
      ++(expected ? admitted : refused);
    }
  }
  EXPECT_GT(admitted, 3000U);
  EXPECT_GT(refused, 2000U);
}

TEST(GroundRobot, KnowsAllAdmittedCellsAtOnceAsItKnowsEach) {
  std::mt19937 engine(2);
  std::size_t compared = 0;
  std::size_t admitted_count = 0;
  for (const double radius_m : {0.0, 0.05, 0.15, 0.28}) {
    const GroundRobot robot({.radius_m = radius_m});
    const OccupancyMap map = random_plane(engine, 40, 0.02);
    const VoxelBox box = map.bounds().grown(2);
    const VoxelGrid<std::uint8_t> admitted = robot.admitted_cells(map, box);
    for_each_cell(box, [&](const VoxelIndex& cell) {
      ASSERT_EQ(admitted[cell] != 0, robot.admits_cell(map, cell)) << radius_m;
      ++compared;
      admitted_count += admitted[cell];
    });
  }
  EXPECT_EQ(compared, 4U * 44U * 44U * 5U);
  EXPECT_GT(admitted_count, 2000U);
}

TEST(GroundRobot, AMotionIsAdmittedExactlyWhenEveryPoseOfItIs) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> metre(0.3, 2.9);
  std::size_t admitted = 0;
  std::size_t refused = 0;
  const GroundRobot robot({.radius_m = 0.12});
  const OccupancyMap map = random_plane(engine, 32, 0.02);
  for (int i = 0; i < 600; ++i) {
    const double height_m = (kLayer + 0.5) * kFloorCell;
    const Pose from = pose_looking({metre(engine), metre(engine), height_m}, 0.0);
    const Pose to = pose_looking({metre(engine), metre(engine), height_m}, 2.0);
    if (!robot.admits(map, from)) {
      continue;
    }
    bool expected = true;
    for (int step = 0; step <= 2000 && expected; ++step) {
      Pose at = from;
      at.translation() += step / 2000.0 * (to.translation() - from.translation());
      expected = disc_is_free(map, at.translation(), 0.12);
    }
    const bool found = robot.admits_motion(map, from, to);
    ASSERT_TRUE(expected || !found);  // samples every millimetre may miss a corner that the motion touches
    ++(found ? admitted : refused);
  }
  EXPECT_GT(admitted, 20U);
  EXPECT_GT(refused, 100U);
}

TEST(GroundRobot, StaysLevelAndInItsLayer) {
  OccupancyMap map({.resolution_m = kFloorCell});
  map.set_log_odds(VoxelBox{{0, 0, 0}, {20, 20, 10}}, -2.0);
  const GroundRobot robot({.radius_m = 0.15});
  EXPECT_FALSE(robot.can_tilt());
  EXPECT_NEAR(optical_axis(robot.facing({1, 1, 0.45}, {1.0, 1.0, 5.0})).z(), 0.0, 1e-12);
  EXPECT_FALSE(robot.admits(map, pose_looking({1.0, 1.0, 0.45}, 0.0, 0.2)));
  EXPECT_TRUE(robot.admits(map, pose_looking({1.0, 1.0, 0.45}, 0.0)));
  EXPECT_FALSE(robot.admits_motion(map, pose_looking({1.0, 1.0, 0.45}, 0.0), pose_looking({1.0, 1.0, 0.75}, 0.0)));
  EXPECT_FALSE(robot.path(map, pose_looking({1.0, 1.0, 0.45}, 0.0), pose_looking({1.0, 1.0, 0.75}, 0.0)));
  EXPECT_TRUE(robot.path(map, pose_looking({0.5, 0.5, 0.45}, 0.0), pose_looking({1.5, 1.5, 0.45}, 0.0)));
}

TEST(GroundRobot, NamesTheOptionAtFault) {
  EXPECT_THROW(GroundRobot({.radius_m = -1.0}), std::invalid_argument);
  EXPECT_THROW(GroundRobot({.radius_m = 0.1, .margin_m = -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
