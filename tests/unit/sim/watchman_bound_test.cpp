// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <stdexcept>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/watchman_bound.hpp>
#include <vantage/sim/watchman_route.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {
namespace {

constexpr double kEdgeM = 0.2;

// Floors of random walls, one cell thick, with gaps; the start is at a corner.
struct RandomFloor {
  explicit RandomFloor(std::uint32_t seed) : world(walls(seed)) {}
  static World walls(std::uint32_t seed) {
    std::mt19937 engine(seed);
    VoxelGrid<std::uint8_t> solid({{0, 0, 0}, {26, 20, 5}}, 1);
    for_each_cell({{1, 1, 1}, {25, 19, 4}}, [&](const VoxelIndex& cell) { solid[cell] = 0; });
    for (std::int32_t x = 6; x < 25; x += 6) {
      const auto gap = static_cast<std::int32_t>(1 + engine() % 14);
      for_each_cell({{x, 1, 1}, {x + 1, 19, 4}},
                    [&](const VoxelIndex& cell) { solid[cell] = cell.y >= gap && cell.y < gap + 4 ? 0 : 1; });
    }
    return {"floor", surface_of_cells(solid, {kEdgeM}, 0.01), {{0, 0, 0}, {kEdgeM * 26, kEdgeM * 20, kEdgeM * 5}}};
  }
  [[nodiscard]] double bound(int threads = 1) const { return watchman_bound(truth, flyer, sensor, start, threads); }
  World world;
  Truth truth{world, kEdgeM, world.region};
  FreeFlyer flyer{FreeFlyerOptions{.radius_m = 0.15}};
  RangeSensor sensor = RangeSensor::preset("panoramic");
  Pose start = pose_looking({0.5, 0.5, 0.5}, 0.0);
};

TEST(WatchmanBound, NeverMoreThanTheShortestRoute) {
  std::size_t cases = 0;
  std::size_t large = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const RandomFloor floor(seed);
    const WatchmanRoute route = watchman_route(floor.truth, floor.flyer, floor.sensor, floor.start);
    if (!route.sees_all) {
      continue;
    }
    const double bound_m = floor.bound();
    EXPECT_LE(bound_m, route.length_m + 1e-4) << "seed " << seed;
    large += bound_m > 0.5 * route.length_m ? 1 : 0;
    ++cases;
  }
  EXPECT_GT(cases, 5U);
  EXPECT_GT(large, cases / 2) << "or it means little";
}

// The layer of a floor in which a robot drives.
TEST(WatchmanBound, NeverMoreThanTheShortestRouteInAPlane) {
  std::size_t cases = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const RandomFloor floor(seed);
    const Truth plane(floor.world, kEdgeM, {{0.0, 0.0, 2 * kEdgeM}, {26 * kEdgeM, 20 * kEdgeM, 3 * kEdgeM}});
    const FreeFlyer flyer(FreeFlyerOptions{.radius_m = 0.05, .margin_m = 0.0});
    const RangeSensor lidar = RangeSensor::spherical(720, 1, 2.0 * std::numbers::pi, 0.01, 0.0, 2.0);
    const WatchmanRoute route = watchman_route(plane, flyer, lidar, floor.start, {.max_witnesses = 12});
    if (route.sees_all) {
      const double bound_m = watchman_bound(plane, flyer, lidar, floor.start);
      EXPECT_LE(bound_m, route.length_m + 1e-4) << "seed " << seed;
      EXPECT_GT(bound_m, 0.0);
      ++cases;
    }
  }
  EXPECT_GT(cases, 3U);
}

TEST(WatchmanBound, TheSameForAnyThreads) {
  const RandomFloor floor(3);
  EXPECT_EQ(floor.bound(2), floor.bound());
}

TEST(WatchmanBound, GivesUpAndRefuses) {
  const RandomFloor floor(1);
  EXPECT_EQ(watchman_bound(floor.truth, floor.flyer, floor.sensor, floor.start, 1, [] { return true; }), 0.0);
  EXPECT_THROW((void)watchman_bound(floor.truth, floor.flyer, floor.sensor, pose_looking({99.0, 9.0, 9.0}, 0.0)),
               std::invalid_argument);
  EXPECT_THROW((void)floor.bound(0), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
