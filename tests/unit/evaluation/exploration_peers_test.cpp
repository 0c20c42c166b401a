// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vantage/evaluation/exploration_peers.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/exploration_run.hpp>

namespace vantage {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

RangeSensor all_round() {
  RangeSensor sensor = RangeSensor::spherical(180, 60, 2.0 * std::numbers::pi, 100.0 * kDegree, 0.0, 5.0);
  sensor.reports_no_return = true;
  return sensor;
}

RangeSensor camera() {
  RangeSensor sensor = RangeSensor::pinhole(80, 60, 90.0 * kDegree, 74.0 * kDegree, 0.1, 5.0);
  sensor.reports_no_return = true;
  return sensor;
}

// A run of a peer in a small generated world, to its end.
RunRecord explored(std::string_view name, const char* world_name, const RangeSensor& sensor, int threads = 1) {
  const World world = World::by_name(world_name, {.seed = 2, .length_m = 9.0, .width_m = 7.0});
  const auto robot = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15, .yaw_only = true});
  ExplorationRun run(
      world, sensor, robot,
      {.map = {.resolution_m = 0.2}, .start_clearance_m = 0.5, .max_views = 3000, .look_around = true});
  const auto peer = make_exploration_peer(name, {.sensor = sensor, .platform = robot, .seed = 3, .threads = threads});
  EXPECT_EQ(peer->name(), name);
  return run.run(*peer, *run.truth().draw_start(*robot, 1));
}

void expect_same(const RunRecord& a, const RunRecord& b) {
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    ASSERT_EQ(a.views[i].pose.matrix(), b.views[i].pose.matrix()) << i;
  }
}

TEST(ExplorationPeers, ExploreToTheEndAndAlwaysTheSameWay) {
  std::size_t runs = 0;
  for (const std::string_view name : exploration_peer_names()) {
    for (const char* world : {"office", "maze"}) {
      const RunRecord record = explored(name, world, all_round());
      EXPECT_EQ(record.outcome, RunOutcome::Explored) << name << ": " << record.reason;
      EXPECT_GE(*record.coverage, 0.99) << name << " in " << world;
      EXPECT_EQ(record.collisions, 0U) << name;
      expect_same(record, explored(name, world, all_round(), 3));
      ++runs;
    }
  }
  EXPECT_EQ(runs, 12U);
}

TEST(ExplorationPeers, ExploreWithANarrowCamera) {
  for (const std::string_view name : exploration_peer_names()) {
    const RunRecord record = explored(name, "maze", camera());
    EXPECT_NE(record.outcome, RunOutcome::Budget) << name << ": " << record.reason;
    EXPECT_NE(record.outcome, RunOutcome::Blocked) << name << ": " << record.reason;
    EXPECT_GE(*record.coverage, 0.99) << name;
    EXPECT_EQ(record.collisions, 0U) << name;
  }
}

TEST(ExplorationPeers, RefuseWhatTheyDoNotKnow) {
  const PlannerSetup setup{.sensor = all_round(), .platform = std::make_shared<FreeFlyer>()};
  try {
    (void)make_exploration_peer("psychic", setup);
    FAIL();
  } catch (const std::invalid_argument& error) {
    for (const std::string_view name : exploration_peer_names()) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  for (const std::string_view name : exploration_peer_names()) {
    EXPECT_THROW((void)make_exploration_peer(name, {}), std::invalid_argument) << name;
  }
}

}  // namespace
}  // namespace vantage
