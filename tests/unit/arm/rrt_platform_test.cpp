// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <stdexcept>
#include <vantage/arm/rrt_platform.hpp>
#include <vantage/robot/free_flyer.hpp>

namespace vantage {
namespace {

const Box kRoom{{0.0, 0.0, 0.0}, {4.0, 4.0, 2.0}};

// A room with two walls across it, each with an opening.
OccupancyMap room_with_walls(std::mt19937& engine) {
  OccupancyMap map({.resolution_m = 0.1, .region = kRoom});
  map.assume_free(kRoom);
  for (const std::int32_t x : {13, 26}) {
    const auto y = static_cast<std::int32_t>(engine() % 32);
    const auto z = static_cast<std::int32_t>(engine() % 12);
    map.set_log_odds(VoxelBox{{x, 0, 0}, {x + 1, 40, 20}}, 3.0);
    map.set_log_odds(VoxelBox{{x, y, z}, {x + 1, y + 8, z + 8}}, -2.0);
  }
  return map;
}

double length_of(const std::vector<Pose>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length_m += (path[i].translation() - path[i - 1].translation()).norm();
  }
  return length_m;
}

TEST(RrtPlatform, FindsAWayThatThePlatformAdmits) {
  std::mt19937 engine(101);
  const auto flyer = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2});
  const RrtPlatform robot(flyer);
  std::uniform_real_distribution<double> side(0.4, 3.6);
  std::uniform_real_distribution<double> height(0.4, 1.6);
  std::size_t found = 0;
  std::size_t corners = 0;
  for (int world = 0; world < 25; ++world) {
    const OccupancyMap map = room_with_walls(engine);
    const Pose from = pose_looking({0.5, side(engine), height(engine)}, 0.0);
    const Pose to = pose_looking({3.5, side(engine), height(engine)}, 1.0);
    const auto path = robot.path(map, from, to);
    ASSERT_TRUE(path.has_value());
    EXPECT_EQ(path->front().matrix(), from.matrix());
    EXPECT_EQ(path->back().matrix(), to.matrix());
    for (std::size_t i = 1; i < path->size(); ++i) {
      EXPECT_TRUE(flyer->admits(map, (*path)[i]));
      EXPECT_TRUE(flyer->admits_motion(map, (*path)[i - 1], (*path)[i]));
    }
    const auto shortest = flyer->path(map, from, to);
    ASSERT_TRUE(shortest.has_value());
    EXPECT_LT(length_of(*path), 4.0 * length_of(*shortest));
    const auto again = robot.path(map, from, to);
    ASSERT_EQ(again->size(), path->size());
    for (std::size_t i = 0; i < path->size(); ++i) {
      EXPECT_EQ((*again)[i].matrix(), (*path)[i].matrix()) << "by the seed";
    }
    ++found;
    corners += path->size() - 2;
  }
  EXPECT_EQ(found, 25U);
  EXPECT_GT(corners, 25U);
}

TEST(RrtPlatform, SaysThatThereIsNoWay) {
  OccupancyMap map({.resolution_m = 0.1, .region = kRoom});
  map.assume_free(kRoom);
  map.set_log_odds(VoxelBox{{20, 0, 0}, {21, 40, 20}}, 3.0);
  const auto flyer = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2});
  const RrtPlatform robot(flyer, {.iterations = 300});
  EXPECT_FALSE(robot.path(map, pose_looking({1, 2, 1}, 0.0), pose_looking({3, 2, 1}, 0.0)));
  EXPECT_FALSE(robot.path(map, pose_looking({1, 2, 1}, 0.0), pose_looking({2.05, 2, 1}, 0.0)));
  EXPECT_EQ(robot.path(map, pose_looking({1, 2, 1}, 0.0), pose_looking({1, 3, 1}, 0.0))->size(), 2U);
}

TEST(RrtPlatform, IsInAllElseThePlatformItIsMadeFrom) {
  std::mt19937 engine(102);
  const OccupancyMap map = room_with_walls(engine);
  const auto flyer = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2, .yaw_only = true});
  const RrtPlatform robot(flyer);
  std::uniform_real_distribution<double> metre(0.0, 4.0);
  std::size_t admitted = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose pose = pose_looking({metre(engine), metre(engine), 0.5 * metre(engine)}, metre(engine));
    EXPECT_EQ(robot.admits(map, pose), flyer->admits(map, pose));
    EXPECT_EQ(robot.admits_cell(map, map.frame().cell_of(pose.translation())),
              flyer->admits_cell(map, map.frame().cell_of(pose.translation())));
    admitted += robot.admits(map, pose) ? 1U : 0U;
  }
  EXPECT_GT(admitted, 100U);
  EXPECT_FALSE(robot.can_tilt());
  EXPECT_THROW(RrtPlatform(nullptr), std::invalid_argument);
  EXPECT_THROW(RrtPlatform(flyer, {.goal_bias = 1.0}), std::invalid_argument);
  EXPECT_THROW(RrtPlatform(flyer, {.step_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(RrtPlatform(flyer, {.iterations = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
