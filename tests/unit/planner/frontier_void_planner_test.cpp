// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/robot/free_flyer.hpp>

#include "contract/cell_world.hpp"

namespace vantage {
namespace {

using testing::CellWorld;

constexpr std::int32_t kX = 34;
constexpr std::int32_t kY = 28;
constexpr std::int32_t kZ = 18;
const VoxelBox kChest{{18, 12, 4}, {26, 20, 12}};

// A closed room with a chest that is open on the side away from the start.
CellWorld chest_world() {
  CellWorld world{VoxelFrame{0.1}, VoxelGrid<std::uint8_t>({{0, 0, 0}, {kX, kY, kZ}}, 1), {4, 4, 8}};
  const auto fill = [&](const VoxelBox& box, std::uint8_t value) {
    for_each_cell(box, [&](const VoxelIndex& cell) { world.solid[cell] = value; });
  };
  fill({{1, 1, 1}, {kX - 1, kY - 1, kZ - 1}}, 0);
  fill(kChest.grown(1), 1);
  fill({kChest.lo, {kChest.hi.x + 1, kChest.hi.y, kChest.hi.z}}, 0);
  return world;
}

struct Robot {
  explicit Robot(bool yaw_only = false)
      : platform(std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1, .yaw_only = yaw_only})) {
    map.assume_free(platform->body_box(pose));
    for (const double yaw : {2.0, 3.6, 5.2, 0.5}) {
      pose = pose_looking(pose.translation(), yaw);
      look();
    }
  }

  void look() { map.insert(testing::scan_cells_of(world, sensor, pose)); }
  [[nodiscard]] PlannerSetup setup() const { return {sensor, platform, 3, 1}; }
  [[nodiscard]] std::size_t unknown_in_the_chest() const {
    std::size_t unknown = 0;
    for_each_cell(kChest, [&](const VoxelIndex& cell) { unknown += map.at(cell) == Occupancy::Unknown ? 1U : 0U; });
    return unknown;
  }
  // Plans and moves until the planner is done. Returns the last plan.
  Plan run(FrontierVoidPlanner& planner) {
    Plan plan = planner.plan(map, pose);
    for (views = 1; plan.outcome == Outcome::Move && views < 150; ++views) {
      pose = plan.goal.pose;
      look();
      plan = planner.plan(map, pose);
    }
    return plan;
  }

  CellWorld world = chest_world();
  RangeSensor sensor = [] {
    RangeSensor camera = RangeSensor::pinhole(96, 72, 1.2, 0.95, 0.2, 4.0);
    camera.reports_no_return = true;
    return camera;
  }();
  std::shared_ptr<const FreeFlyer> platform;
  OccupancyMap map{{.resolution_m = 0.1, .region = world.frame.box_of(world.solid.box())}};
  Pose pose = pose_looking(world.frame.centre_of(world.start), 0.5);
  std::size_t views = 0;
};

TEST(FrontierVoidPlanner, LooksIntoTheChest) {
  Robot robot;
  FrontierVoidPlanner planner(robot.setup());
  EXPECT_GT(robot.unknown_in_the_chest(), kChest.size() * 9 / 10);
  const Plan last = robot.run(planner);
  EXPECT_EQ(last.outcome, Outcome::Explored) << last.reason;
  EXPECT_LT(robot.views, 40U);
  EXPECT_EQ(robot.unknown_in_the_chest(), 0U);
}

TEST(FrontierVoidPlanner, SaysWhatAViewSeesExactly) {
  Robot robot;
  const FrontierVoidOptions first_cells{.strategy = {.mode = VoidMode::Faithful}};
  const auto fresh_plan = [&] { return FrontierVoidPlanner(robot.setup(), first_cells).plan(robot.map, robot.pose); };
  std::size_t compared = 0;
  for (Plan plan = fresh_plan(); plan.outcome == Outcome::Move && compared < 12; plan = fresh_plan()) {
    const std::vector<VoxelIndex> voids = void_cells(robot.map);
    EXPECT_EQ(plan.statistics.void_cells, voids.size());
    EXPECT_EQ(plan.statistics.frontier_cells, count_frontier_cells(robot.map));
    CellSet seen;
    (void)UniformRayTracer(robot.map).evaluate(plan.goal.pose, ViewRays(robot.sensor.rays_for(0.1)),
                                               robot.map.bounds(), &seen);
    const auto count =
        std::count_if(voids.begin(), voids.end(), [&](const VoxelIndex& cell) { return seen.contains(cell); });
    EXPECT_EQ(plan.goal.utility, static_cast<double>(count));
    EXPECT_EQ(count == 0, plan.reason.find("no view sees a void") != std::string::npos) << plan.reason;
    ++compared;
    robot.pose = plan.goal.pose;
    robot.look();
  }
  EXPECT_GE(compared, 6U);
}

TEST(FrontierVoidPlanner, ExpectsMoreThanTheFirstCells) {
  const Robot robot;
  const FrontierVoidOptions first_cells{.strategy = {.mode = VoidMode::Faithful}};
  const Plan first = FrontierVoidPlanner(robot.setup(), first_cells).plan(robot.map, robot.pose);
  const Plan through = FrontierVoidPlanner(robot.setup()).plan(robot.map, robot.pose);
  EXPECT_GT(through.goal.utility, 1.5 * first.goal.utility);
}

// The straight distance of every finalist counts; finalists to which no path leads or that see no target do not
// count.
TEST(FrontierVoidPlanner, TakesTheBestForItsDistance) {
  constexpr double kCostPerM = 20.0;
  Robot robot;
  const FrontierVoidOptions options{.strategy = {.mode = VoidMode::Searching, .cost_per_m = kCostPerM}};
  const auto value = [&](const View& view) {
    return view.utility / (1.0 + kCostPerM * (view.pose.translation() - robot.pose.translation()).norm());
  };
  std::size_t compared = 0;
  for (int step = 0; step < 8; ++step) {
    const Plan plan = FrontierVoidPlanner(robot.setup(), options).plan(robot.map, robot.pose);
    if (plan.outcome != Outcome::Move || plan.candidates.empty()) {
      break;
    }
    Situation situation(robot.setup(), options.survey);
    situation.sync(robot.map, robot.pose);
    std::uint64_t operations = 0;
    for (const View& other : plan.candidates) {
      if (robot.platform->path(robot.map, robot.pose, other.pose) &&
          !targets_seen_from(situation.surveyed(), other.pose, operations).unknown.empty()) {
        EXPECT_GE(value(plan.goal), value(other)) << "step " << step;
        ++compared;
      }
    }
    robot.pose = plan.goal.pose;
    robot.look();
  }
  EXPECT_GE(compared, 50U);
}

// A robot that plans on its way weighs its goal against the views that it draws anew. So it does not turn to and fro.
TEST(FrontierVoidPlanner, WeighsTheGoalAheadAgain) {
  Robot robot;
  FrontierVoidPlanner planner(robot.setup());
  std::size_t weighed = 0;
  Plan plan = planner.plan(robot.map, robot.pose);
  for (int step = 0; step < 40 && plan.outcome == Outcome::Move; ++step) {
    const Pose goal = plan.goal.pose;
    const Eigen::Vector3d way = plan.path[1].translation() - robot.pose.translation();
    const bool is_on_its_way = way.norm() > 0.5;
    robot.pose = is_on_its_way ? robot.pose : goal;
    if (is_on_its_way) {
      robot.pose.translation() += 0.4 * way.normalized();
    }
    robot.look();
    plan = planner.plan(robot.map, robot.pose);
    const bool knows = std::any_of(plan.candidates.begin(), plan.candidates.end(),
                                   [&](const View& view) { return view.pose.matrix() == goal.matrix(); });
    weighed += is_on_its_way && knows ? 1U : 0U;
  }
  EXPECT_GT(weighed, 2U);
}

TEST(FrontierVoidPlanner, EndsWhereNoViewIsWorthIt) {
  Robot robot;
  const double of_the_chest_m3 = 1e-3 * static_cast<double>(kChest.size());  // cells of 0.1 m
  FrontierVoidPlanner planner(robot.setup(),
                              {.strategy = {.least_view_m3 = 0.05 * of_the_chest_m3, .beyond_voids = false}});
  const Plan last = robot.run(planner);
  EXPECT_EQ(last.outcome, Outcome::Blocked);
  EXPECT_LT(robot.unknown_in_the_chest(), kChest.size() / 5) << last.reason;
  FrontierVoidPlanner content(robot.setup(), {.strategy = {.least_view_m3 = 1e6, .beyond_voids = false}});
  EXPECT_NE(content.plan(robot.map, robot.pose).reason.find("is below"), std::string::npos);
}

TEST(FrontierVoidPlanner, ShowsWhatThePlanWasMadeFrom) {
  const Robot robot;
  FrontierVoidPlanner planner(robot.setup());
  const Plan plan = planner.plan(robot.map, robot.pose);
  ASSERT_EQ(plan.outcome, Outcome::Move);
  const VoidSearch& search = planner.search();
  EXPECT_EQ(search.frontier.size(), plan.statistics.observable_cells);
  EXPECT_FALSE(search.frontier_voids.empty());
  EXPECT_EQ(search.places.size(), search.utility.size());
  EXPECT_GT(search.places.size(), 100U);
  EXPECT_TRUE(std::all_of(search.utility.begin(), search.utility.end(), [](auto u) { return u > 0; }));
  for (const VoxelIndex& cell : void_cells(robot.map)) {
    ASSERT_NE(search.voids.number_at(cell), VoidClusters::kNone);
  }
}

// The hull of the returns holds millions of cells that no view can see.
TEST(FrontierVoidPlanner, ClustersOnlyWhatAViewCanSee) {
  Robot robot;
  Scan wild{.world_from_sensor = robot.pose};
  wild.points = {{1.0F, 0.2F, 80.0F}, {-70.0F, 0.1F, 60.0F}, {30.0F, 0.5F, 100.0F}};
  OccupancyMap map({.resolution_m = 0.1});
  map.assume_free(robot.platform->body_box(robot.pose));
  map.insert(testing::scan_cells_of(robot.world, robot.sensor, robot.pose));
  map.insert(wild);
  FrontierVoidPlanner planner(robot.setup());
  const Plan plan = planner.plan(map, robot.pose);
  ASSERT_EQ(plan.outcome, Outcome::Move) << plan.reason;
  const std::int32_t reach = 40 + 64 + 32;  // the range, a tile, and the cells that share a box
  std::size_t clustered = 0;
  planner.search().voids.for_each_cell([&](const VoxelIndex& cell) {
    ++clustered;
    ASSERT_TRUE(
        std::any_of(planner.search().frontier.begin(), planner.search().frontier.end(), [&](const VoxelIndex& other) {
          return VoxelBox{other, other + VoxelIndex{1, 1, 1}}.grown(reach).contains(cell);
        }));
  });
  EXPECT_GT(plan.statistics.void_cells, 1'000'000U);
  EXPECT_GT(clustered, 1'000U);
  EXPECT_LT(clustered, plan.statistics.void_cells / 4);
}

TEST(FrontierVoidPlanner, ALevelPlatformStaysLevel) {
  Robot robot(true);
  FrontierVoidPlanner planner(robot.setup());
  const Plan last = robot.run(planner);
  EXPECT_EQ(last.outcome, Outcome::Explored) << last.reason;
  EXPECT_NEAR(optical_axis(robot.pose).z(), 0.0, 1e-9);
  EXPECT_LT(robot.unknown_in_the_chest(), kChest.size() / 10);
}

// Free space without obstacles has no hull, and so no void.
TEST(FrontierVoidPlanner, EndsAsThePaperDoesOnlyWhenAsked) {
  Robot robot;
  OccupancyMap open({.resolution_m = 0.1});
  open.assume_free({{-1, -1, -1}, {1, 1, 1}});
  const Pose here = pose_looking({0.05, 0.05, 0.05}, 0.0);
  const Plan on = FrontierVoidPlanner(robot.setup()).plan(open, here);
  EXPECT_EQ(on.outcome, Outcome::Move);
  EXPECT_EQ(on.goal.utility, 0.0);
  EXPECT_NE(on.reason.find("no view sees a void"), std::string::npos) << on.reason;
  const Plan end =
      FrontierVoidPlanner(robot.setup(), {.strategy = FrontierVoidStrategy::faithful()}).plan(open, here);
  EXPECT_EQ(end.outcome, Outcome::Blocked);
  EXPECT_NE(end.reason.find("the best utility is 0"), std::string::npos) << end.reason;
  EXPECT_NE(end.reason.find("beyond_voids=true goes on"), std::string::npos) << end.reason;
  EXPECT_GT(end.statistics.observable_cells, 0U);
  FrontierVoidOptions least{.strategy = FrontierVoidStrategy::faithful()};
  least.strategy.least_view_m3 = 0.1;
  const Plan early = FrontierVoidPlanner(robot.setup(), least).plan(open, here);
  EXPECT_EQ(early.outcome, Outcome::Blocked);
  EXPECT_NE(early.reason.find("below least_view_m3 (a smaller one goes on)"), std::string::npos) << early.reason;
}

TEST(FrontierVoidPlanner, ThePapersMethodLooksIntoTheChestToo) {
  Robot robot;
  FrontierVoidPlanner planner(robot.setup(), {.strategy = FrontierVoidStrategy::faithful()});
  const Plan last = robot.run(planner);
  EXPECT_NE(last.outcome, Outcome::Move);
  EXPECT_EQ(robot.unknown_in_the_chest(), 0U) << last.reason;
}

TEST(FrontierVoidPlanner, RefusesWhatItCannotUse) {
  const Robot robot;
  const auto message = [&](const FrontierVoidOptions& options) -> std::string {
    try {
      const FrontierVoidPlanner planner(robot.setup(), options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({}), "");
  EXPECT_EQ(message({.clusters = {.min_score = -1.0}}), "FrontierVoidOptions::min_score is -1, must be > 0");
  EXPECT_EQ(message({.strategy = {.views = 0}}), "FrontierVoidOptions::views is 0, must be in [1, 1e+06]");
  EXPECT_EQ(message({.strategy = {.cost_per_m = -1.0}}), "FrontierVoidOptions::cost_per_m is -1, must be >= 0");
  EXPECT_EQ(message({.strategy = {.least_view_m3 = -1.0}}), "FrontierVoidOptions::least_view_m3 is -1, must be >= 0");
}

}  // namespace
}  // namespace vantage
