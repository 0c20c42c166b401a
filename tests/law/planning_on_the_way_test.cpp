// SPDX-License-Identifier: MIT
// A robot that plans again after every short stretch of its path explores as one that goes to each goal does. Many
// frontiers are far away and about equally good, so a planner that weighs them anew each time may turn around for
// ever.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/ground_robot.hpp>

#include "contract/cell_world.hpp"
#include "support/every_planner.hpp"

namespace vantage {
namespace {

constexpr std::int32_t kSpacing = 25;  // between drifts, in cells
constexpr double kLimitM = 6000.0;     // ends a run that would not end by itself

// Drifts of five cells in both directions, in one layer.
testing::CellWorld mine(std::int32_t drifts) {
  const std::int32_t side = kSpacing * (drifts - 1) + 7;
  testing::CellWorld world;
  world.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {side, side, 1}}, 1);
  world.start = {3, 3, 0};
  for (std::int32_t drift = 0; drift < drifts; ++drift) {
    const std::int32_t at = 1 + drift * kSpacing;
    testing::fill_cells(world.solid, {{at, 1, 0}, {at + 5, side - 1, 1}}, 0);
    testing::fill_cells(world.solid, {{1, at, 0}, {side - 1, at + 5, 1}}, 0);
  }
  return world;
}

struct Exploration {
  Plan last;
  double gone_m = 0.0;
};

// Explores; goes at most `step_m` between two plans.
Exploration explore(const std::string& name, std::int32_t drifts, double step_m) {
  const testing::CellWorld world = mine(drifts);
  RangeSensor sensor = RangeSensor::spherical(360, 1, 2.0 * std::numbers::pi, 0.001, 0.0, 4.0);
  sensor.reports_no_return = true;
  const auto platform = std::make_shared<const GroundRobot>(GroundRobotOptions{.radius_m = 0.25});
  OccupancyMap map({.resolution_m = world.frame.size_m, .region = world.frame.box_of(world.solid.box())});
  const auto planner = make_planner(name, {.sensor = sensor, .platform = platform, .seed = 5});
  Pose pose = pose_looking(world.frame.centre_of(world.start), 0.0);
  assume_free(map, *platform, pose);
  Exploration run;
  while (run.gone_m < kLimitM) {
    map.insert(testing::scan_cells_of(world, sensor, pose));
    run.last = planner->plan(map, pose);
    if (run.last.outcome != Outcome::Move) {
      break;
    }
    double left_m = step_m;
    for (std::size_t i = 1; i < run.last.path.size() && left_m > 0.0; ++i) {
      const Pose& next = run.last.path[i];
      const Eigen::Vector3d way = next.translation() - pose.translation();
      const double part = way.norm() > left_m ? left_m / way.norm() : 1.0;
      const Eigen::Vector3d stop = pose.translation() + part * way;
      run.gone_m += part * way.norm();
      left_m -= way.norm();
      pose = next;
      pose.translation() = stop;
    }
  }
  return run;
}

class PlanningOnTheWay : public ::testing::TestWithParam<std::string> {};

void expect_as_from_goal_to_goal(const std::string& planner, std::int32_t drifts, double step_m) {
  const Exploration to_goals = explore(planner, drifts, kLimitM);
  const Exploration on_the_way = explore(planner, drifts, step_m);
  EXPECT_EQ(to_goals.last.outcome, Outcome::Explored) << to_goals.last.reason;
  EXPECT_EQ(on_the_way.last.outcome, Outcome::Explored) << on_the_way.last.reason;
  EXPECT_LE(on_the_way.gone_m, 2.0 * to_goals.gone_m) << "from goal to goal: " << to_goals.gone_m;
  ::testing::Test::RecordProperty("to_goals_m", std::to_string(to_goals.gone_m));
  ::testing::Test::RecordProperty("on_the_way_m", std::to_string(on_the_way.gone_m));
}

TEST_P(PlanningOnTheWay, AfterTwoCells) { expect_as_from_goal_to_goal(GetParam(), 10, 0.4); }

// A host that plans at a fixed rate.
TEST_P(PlanningOnTheWay, AfterAFewCentimetres) { expect_as_from_goal_to_goal(GetParam(), 4, 0.03); }

// A viewpoint may be on the far side of what it sees, where the robot was when it was found. A tour over such places
// leads around the blocks between the drifts.
TEST(TourOfDrifts, IsHardlyLongerThanTheNearestFrontierFirst) {
  const Exploration tour = explore("tour", 6, kLimitM);
  const Exploration nearest = explore("nearest-frontier", 6, kLimitM);
  EXPECT_EQ(tour.last.outcome, Outcome::Explored) << tour.last.reason;
  EXPECT_LE(tour.gone_m, 1.3 * nearest.gone_m) << nearest.gone_m;
}

INSTANTIATE_TEST_SUITE_P(Every, PlanningOnTheWay, ::testing::ValuesIn(test::every_planner()), test::name_of_planner);

}  // namespace
}  // namespace vantage
