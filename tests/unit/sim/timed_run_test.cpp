// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>

namespace vantage {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const MotionModel kMotion{
    .max_speed_m_s = 2.0, .max_acceleration_m_s2 = 3.0, .max_yaw_rate_rad_s = 90.0 * kDegree, .scan_rate_hz = 5.0};

struct Flight {
  World world = World::by_name("office", {.seed = 2, .length_m = 9.0, .width_m = 7.0});
  RangeSensor sensor;
  std::shared_ptr<const FreeFlyer> robot;
  ExplorationRun run;
  RunRecord record;

  Flight(const RangeSensor& eye, const std::string& planner, const MotionModel& motion, std::size_t max_views = 2000,
         bool look_around = false, bool yaw_only = true)
      : sensor(eye),
        robot(std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15, .yaw_only = yaw_only})),
        run(world, sensor, robot,
            {.map = {.resolution_m = 0.2},
             .start_clearance_m = 0.5,
             .max_views = max_views,
             .motion = motion,
             .look_around = look_around}) {
    const auto explorer = make_planner(planner, {.sensor = sensor, .platform = robot});
    record = run.run(*explorer, *run.truth().draw_start(*robot, 1));
  }
};

RangeSensor all_round() { return RangeSensor::spherical(180, 60, 2.0 * std::numbers::pi, 100.0 * kDegree, 0.0, 5.0); }

// What a scan may differ from the one before, at most.
void expect_motion_within_limits(const RunRecord& record, const MotionModel& motion) {
  double turned_deg = 0.0;
  for (std::size_t i = 1; i < record.views.size(); ++i) {
    const ViewRecord& before = record.views[i - 1];
    const ViewRecord& now = record.views[i];
    const double seconds = *now.time_s - *before.time_s;
    EXPECT_NEAR(*now.time_s, static_cast<double>(i) / motion.scan_rate_hz, 1e-9);
    EXPECT_LE(now.path_length_m - before.path_length_m, motion.max_speed_m_s * seconds + 1e-6);
    EXPECT_GE(now.path_length_m - before.path_length_m + 1e-9,
              (now.pose.translation() - before.pose.translation()).norm());
    const double turned =
        Eigen::AngleAxisd(Eigen::Matrix3d(before.pose.linear().transpose() * now.pose.linear())).angle();
    EXPECT_LE(turned, motion.max_yaw_rate_rad_s * seconds + 1e-6);
    turned_deg += turned / kDegree;
  }
  EXPECT_GE(record.turned_deg, turned_deg - 1e-6);
}

TEST(TimedRun, EveryPlannerExploresInTime) {
  for (const std::string planner : {"harmonic", "nearest-frontier", "frontier-gain", "frontier-void"}) {
    const Flight flight(all_round(), planner, kMotion);
    const RunRecord& record = flight.record;
    EXPECT_EQ(record.outcome, RunOutcome::Explored) << planner << ": " << record.reason;
    EXPECT_GT(*record.coverage, 0.98) << planner;
    EXPECT_EQ(record.collisions, 0U) << planner;
    expect_motion_within_limits(record, kMotion);
    ASSERT_TRUE(record.duration_s) << planner;
    EXPECT_LE(*record.duration_s, *record.views.back().time_s);
    EXPECT_GT(*record.duration_s, record.path_length_m() / kMotion.max_speed_m_s * 0.5);
    // It does not stop for every scan: its mean speed is more than a quarter of the highest.
    EXPECT_GT(record.path_length_m() / *record.views.back().time_s, kMotion.max_speed_m_s / 4.0) << planner;
  }
}

TEST(TimedRun, ANarrowCameraIsTurnedWithinItsLimits) {
  MotionModel motion = kMotion;
  motion.max_yaw_acceleration_rad_s2 = 3.0;
  const RangeSensor camera = RangeSensor::pinhole(80, 60, 90.0 * kDegree, 74.0 * kDegree, 0.1, 5.0);
  const Flight flight(camera, "nearest-frontier", motion, 3000, true);
  const RunRecord& record = flight.record;
  expect_motion_within_limits(record, motion);
  EXPECT_EQ(record.collisions, 0U);
  EXPECT_GT(*record.coverage, 0.9) << record.reason;
  for (const ViewRecord& view : record.views) {
    EXPECT_NEAR(optical_axis(view.pose).z(), 0.0, 1e-9);
  }
  // It looks around first: nothing is planned until it has turned by more than half.
  std::size_t unplanned = 0;
  while (record.views[unplanned].plan_ms == 0.0) {
    ++unplanned;
  }
  EXPECT_GT(*record.views[unplanned].time_s, std::numbers::pi / motion.max_yaw_rate_rad_s);
  EXPECT_EQ(record.views[unplanned].path_length_m, 0.0);
}

TEST(TimedRun, IsTheSameEveryTime) {
  const Flight first(all_round(), "harmonic", kMotion);
  const Flight second(all_round(), "harmonic", kMotion);
  ASSERT_EQ(first.record.views.size(), second.record.views.size());
  for (std::size_t i = 0; i < first.record.views.size(); ++i) {
    EXPECT_EQ(first.record.views[i].pose.matrix(), second.record.views[i].pose.matrix());
  }
  EXPECT_EQ(first.record.duration_s, second.record.duration_s);
  EXPECT_EQ(first.record.turned_deg, second.record.turned_deg);
}

TEST(TimedRun, APlanTakesEffectWhenItIsDue) {
  MotionModel motion = kMotion;
  motion.planning_latency_s = 1.0;  // five scans
  const Flight flight(all_round(), "nearest-frontier", motion);
  std::optional<double> asked_s;
  std::size_t plans = 0;
  for (const ViewRecord& view : flight.record.views) {
    if (view.plan_ms > 0.0) {
      EXPECT_TRUE(!asked_s || *view.time_s >= *asked_s + motion.planning_latency_s - 1e-9);
      asked_s = view.time_s;
      ++plans;
    }
    if (view.time_s < motion.planning_latency_s) {
      EXPECT_EQ(view.path_length_m, 0.0);
    }
  }
  EXPECT_GT(plans, 3U);
  EXPECT_EQ(flight.record.outcome, RunOutcome::Explored) << flight.record.reason;
  const Flight quick(all_round(), "nearest-frontier", kMotion);
  EXPECT_LT(*quick.record.duration_s, *flight.record.duration_s);
}

TEST(TimedRun, EndsWithItsBudget) {
  const Flight flight(all_round(), "harmonic", kMotion, 12);
  EXPECT_EQ(flight.record.outcome, RunOutcome::Budget);
  EXPECT_EQ(flight.record.views.size(), 12U);
}

TEST(TimedRun, AnUntimedRunCountsItsTurnsOnly) {
  const World world = World::by_name("office", {.seed = 2, .length_m = 9.0, .width_m = 7.0});
  const auto robot = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15, .yaw_only = true});
  const RangeSensor sensor = all_round();
  ExplorationRun run(world, sensor, robot, {.map = {.resolution_m = 0.2}, .max_views = 10});
  const auto explorer = make_planner("harmonic", {.sensor = sensor, .platform = robot});
  const RunRecord record = run.run(*explorer, *run.truth().draw_start(*robot, 1));
  EXPECT_FALSE(record.duration_s);
  EXPECT_FALSE(record.views.back().time_s);
  EXPECT_GT(record.turned_deg, 0.0);
}

TEST(TimedRun, RefusesAMotionThatIsNone) {
  EXPECT_THROW(Flight(all_round(), "harmonic", {.max_speed_m_s = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
