// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>

namespace vantage {
namespace {

// Two rooms without a door between them, a large and a small one, of cells of 0.2 m.
World two_rooms() {
  OccupancyMap map({.resolution_m = 0.2});
  for (std::int32_t z = 0; z < 6; ++z) {
    for (std::int32_t y = 0; y < 10; ++y) {
      for (std::int32_t x = 0; x < 20; ++x) {
        if (x < 10 || (x >= 14 && y < 5)) {
          map.set({x, y, z}, Occupancy::Free);
        }
      }
    }
  }
  return World::from_map("two rooms", map);
}

TEST(RepeatedRun, KnowsWhatCanBeSeenFromEachStart) {
  const World world = two_rooms();
  const RangeSensor sensor = RangeSensor::preset("panoramic");
  const auto robot = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1});
  const ExplorationRunOptions options{.map = {.resolution_m = 0.2}, .max_views = 3};
  Pose large = Pose::Identity();
  large.translation() = Eigen::Vector3d(1.1, 1.1, 0.5);
  Pose small = Pose::Identity();
  small.translation() = Eigen::Vector3d(3.3, 0.5, 0.5);
  ExplorationRun repeated(world, sensor, robot, options);
  std::size_t searches = 0;
  ExplorationRunOptions counted = options;
  counted.on_observable_share = [&](double share) { searches += share >= 1.0 ? 1 : 0; };
  ExplorationRun counting(world, sensor, robot, counted);
  for (const Pose& start : {large, large, small, large}) {
    const auto run_in = [&](ExplorationRun& run) {
      const auto planner = make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});
      return run.run(*planner, start);
    };
    ExplorationRun fresh(world, sensor, robot, options);
    const RunRecord expected = run_in(fresh);
    EXPECT_GT(expected.observable_cells, 100U);
    for (const RunRecord& record : {run_in(repeated), run_in(counting)}) {
      EXPECT_EQ(record.observable_cells, expected.observable_cells);
      EXPECT_EQ(record.coverage, expected.coverage);
      EXPECT_EQ(record.path_length_m(), expected.path_length_m());
    }
  }
  EXPECT_EQ(searches, 3U);  // the second start is that of the run before
}

}  // namespace
}  // namespace vantage
