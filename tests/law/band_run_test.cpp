// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/exploration_run.hpp>

namespace vantage {
namespace {

const HeightBandOptions kBand{.min_height_m = 0.2, .max_height_m = 1.4, .sensor_height_m = 0.9};

struct Drive {
  World world = World::by_name("maze", {.seed = 3, .length_m = 8.0, .width_m = 6.0});
  RangeSensor sensor;
  std::shared_ptr<const GroundRobot> robot =
      std::make_shared<const GroundRobot>(GroundRobotOptions{.radius_m = 0.15});
  ExplorationRun run;

  Drive(const std::string& preset, bool look_around)
      : sensor(RangeSensor::preset(preset)),
        run(world, sensor, robot,
            {.map = {.resolution_m = 0.1}, .band = kBand, .max_views = 150, .look_around = look_around}) {}
};

TEST(BandRun, EveryPlannerExploresThePlane) {
  for (const std::string planner : {"harmonic", "nearest-frontier", "frontier-gain"}) {
    Drive drive("panoramic", false);
    const auto explorer = make_planner(planner, {.sensor = drive.sensor, .platform = drive.robot});
    const std::optional<Pose> start = drive.run.truth().draw_start(*drive.robot, 1);
    ASSERT_TRUE(start);
    const RunRecord record = drive.run.run(*explorer, *start);
    EXPECT_EQ(record.outcome, RunOutcome::Explored) << planner << ": " << record.reason;
    EXPECT_GT(*record.coverage, 0.98) << planner;
    EXPECT_GT(record.observable_cells, 1000U);
    EXPECT_EQ(record.collisions, 0U) << planner;
    for (const ViewRecord& view : record.views) {
      EXPECT_NEAR(view.pose.translation().z(), start->translation().z(), 1e-9);
      EXPECT_NEAR(optical_axis(view.pose).z(), 0.0, 1e-9);
    }
    EXPECT_EQ(drive.run.known().bounds().extent().z, 1);
    EXPECT_GT(drive.run.map().bounds().extent().z, 10);
  }
}

TEST(BandRun, ANarrowCameraLooksAroundBeforeItPlans) {
  Drive drive("stereo", true);
  const auto explorer = make_planner("harmonic", {.sensor = drive.sensor, .platform = drive.robot});
  const std::optional<Pose> start = drive.run.truth().draw_start(*drive.robot, 1);
  ASSERT_TRUE(start);
  std::size_t unplanned = 0;
  const RunRecord record = drive.run.run(*explorer, *start);
  while (record.views[unplanned].plan_ms == 0.0) {
    ++unplanned;
  }
  EXPECT_EQ(unplanned + 1, static_cast<std::size_t>(std::ceil(360.0 / (0.8 * 65.0))));
  for (std::size_t view = 1; view <= unplanned; ++view) {
    EXPECT_EQ(record.views[view].pose.translation(), start->translation());
    EXPECT_NEAR(optical_axis(record.views[view].pose).dot(optical_axis(record.views[view - 1].pose)),
                std::cos(2.0 * std::numbers::pi / static_cast<double>(unplanned + 1)), 1e-9);
  }
  EXPECT_EQ(record.outcome, RunOutcome::Explored) << record.reason;
  EXPECT_GT(*record.coverage, 0.9);
}

TEST(BandRun, RefusesABoxOfTheUnknownInABand) {
  const World world = World::by_name("maze");
  EXPECT_THROW(ExplorationRun(world, RangeSensor::preset("panoramic"), std::make_shared<const GroundRobot>(),
                              {.band = kBand, .unknown_box = Box{{0, 0, 0}, {1, 1, 1}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace vantage
