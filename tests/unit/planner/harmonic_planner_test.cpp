// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vantage/field/streamline.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/robot/free_flyer.hpp>

#include "grid_world.hpp"

namespace vantage {
namespace {

PlannerSetup setup_with(const RangeSensor& sensor, const FreeFlyerOptions& body = {.radius_m = 0.15}) {
  return {.sensor = sensor, .platform = std::make_shared<FreeFlyer>(body)};
}

RangeSensor all_around() {
  RangeSensor sensor = RangeSensor::spherical(120, 60, 2.0 * std::numbers::pi, std::numbers::pi, 0.0, 6.0);
  sensor.reports_no_return = true;
  return sensor;
}

// A closed box of 20 x 16 x 12 free cells with an opening of 2 x 2 cells in the wall at x = 20; the space beyond is
// unknown.
OccupancyMap box_with_opening() {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{-1, -1, -1}, {21, 17, 13}}, [&](const VoxelIndex& cell) {
    const bool inside = VoxelBox{{0, 0, 0}, {20, 16, 12}}.contains(cell);
    const bool opening = cell.x == 20 && cell.y >= 11 && cell.y < 13 && cell.z >= 5 && cell.z < 7;
    map.set(cell, inside || opening ? Occupancy::Free : Occupancy::Occupied);
  });
  return map;
}

void expect_admitted(const OccupancyMap& map, const Platform& platform, const Pose& current, const Plan& plan) {
  ASSERT_GE(plan.path.size(), 2U);
  EXPECT_TRUE(plan.path.front().isApprox(current));
  EXPECT_TRUE(plan.path.back().isApprox(plan.goal.pose));
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    EXPECT_TRUE(platform.admits(map, plan.path[i])) << i;
    EXPECT_TRUE(platform.admits_motion(map, plan.path[i - 1], plan.path[i])) << i;
  }
}

// The boundary conditions of the paper (IV-B) and their purpose: the streamline leads to the opening.
TEST(HarmonicPlanner, InAClosedBoxWithOneOpeningTheStreamlineLeadsThere) {
  const OccupancyMap map = box_with_opening();
  const Pose current = pose_looking({0.5, 0.5, 0.5}, 0.0);
  for (const FieldSolver solver : {FieldSolver::Multigrid, FieldSolver::GaussSeidel}) {
    for (const NeumannScheme neumann : {NeumannScheme::FiniteVolume, NeumannScheme::Mirror}) {
      if (solver == FieldSolver::Multigrid && neumann == NeumannScheme::Mirror) {
        continue;  // refused
      }
      const PlannerSetup setup = setup_with(all_around());
      HarmonicPlanner planner(
          setup, {.field = {.solver = solver, .neumann = neumann}, .strategy = HarmonicStrategy::faithful()});
      const Plan plan = planner.plan(map, current);
      ASSERT_EQ(plan.outcome, Outcome::Move) << plan.reason;
      expect_admitted(map, *setup.platform, current, plan);
      EXPECT_LT((plan.goal.pose.translation() - Eigen::Vector3d(4.0, 2.4, 1.2)).norm(), 0.7);
      EXPECT_GT(optical_axis(plan.goal.pose).x(), 0.5);  // looks out into the unknown

      ASSERT_TRUE(planner.field());
      const HarmonicField& field = *planner.field();
      EXPECT_TRUE(field.followed);
      EXPECT_EQ(field.stuck_cells, 0U);
      const LaplaceDomain& domain = field.potential.domain();
      EXPECT_EQ(domain.cell_count(), plan.statistics.reachable_cells);
      EXPECT_EQ(field.potential.at(field.potential.source()), 1.0);
      EXPECT_EQ(field.potential.source(), map.frame().cell_of(current.translation()));
      std::size_t sinks = 0;
      domain.for_each_cell([&](const VoxelIndex& cell) {
        sinks += domain.is_sink(cell) && field.potential.at(cell) == 0.0 ? 1U : 0U;
      });
      EXPECT_EQ(sinks, domain.sink_count());
      EXPECT_GE(sinks, 1U);
      EXPECT_EQ(plan.statistics.solver_sweeps, field.sweeps);
    }
  }
}

TEST(HarmonicPlanner, SameMapSamePlanAndPlanningTwiceChangesNothing) {
  const OccupancyMap map = box_with_opening();
  const Pose current = pose_looking({0.7, 2.5, 1.5}, 1.0);
  HarmonicPlanner planner(setup_with(all_around()));
  HarmonicPlanner other(setup_with(all_around()));
  const Plan first = planner.plan(map, current);
  const Plan second = planner.plan(map, current);
  const Plan third = other.plan(map, current);
  ASSERT_EQ(first.path.size(), second.path.size());
  ASSERT_EQ(first.path.size(), third.path.size());
  for (std::size_t i = 0; i < first.path.size(); ++i) {
    EXPECT_EQ(first.path[i].matrix(), second.path[i].matrix());
    EXPECT_EQ(first.path[i].matrix(), third.path[i].matrix());
  }
}

double length_m(const Plan& plan) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    sum_m += (plan.path[i].translation() - plan.path[i - 1].translation()).norm();
  }
  return sum_m;
}

// From every corner of the box: the view is taken where the frontier first comes into sight, so the path is never
// longer than the path to the frontier.
TEST(HarmonicPlanner, LooksFromTheFirstPlaceThatSeesTheBoundary) {
  const OccupancyMap map = box_with_opening();
  const PlannerSetup setup = setup_with(all_around());
  std::size_t shorter = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at(corner % 2 == 0 ? 0.5 : 3.5, corner / 2 % 2 == 0 ? 0.5 : 2.7, corner < 4 ? 0.5 : 1.9);
    const Pose current = pose_looking(at, 0.0);
    HarmonicPlanner early(setup);
    HarmonicPlanner late(setup, {.strategy = {.look_early = false}});
    const Plan plan = early.plan(map, current);
    const Plan beside = late.plan(map, current);
    ASSERT_EQ(plan.outcome, Outcome::Move) << plan.reason;
    expect_admitted(map, *setup.platform, current, plan);
    ASSERT_FALSE(plan.sought.empty());
    std::uint64_t operations = 0;
    for (const VoxelIndex& unknown : plan.sought) {
      EXPECT_TRUE(sees(map, setup.sensor, plan.goal.pose, unknown, operations));
    }
    EXPECT_LT(length_m(plan), length_m(beside) + 0.3);
    shorter += length_m(plan) < length_m(beside) - 0.3 ? 1U : 0U;
  }
  EXPECT_GE(shorter, 4U);
}

TEST(HarmonicPlanner, EquationNineIsRelaxed) {
  const PlannerSetup setup = setup_with(all_around());
  try {
    (void)HarmonicPlanner(setup, {.field = {.neumann = NeumannScheme::Mirror}});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "HarmonicOptions::neumann is mirror, must be finite-volume with solver=multigrid");
  }
}

// Near frontiers come first, even if a large frontier further away attracts more flow.
TEST(HarmonicPlanner, ClearsWhatIsNearBeforeItGoesFar) {
  OccupancyMap map = box_with_opening();
  for_each_cell({{20, 2, 2}, {21, 14, 10}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  map.set({4, -1, 5}, Occupancy::Free);  // one cell in the near wall
  const Pose current = pose_looking({1.9, 0.9, 1.1}, 0.0);
  HarmonicPlanner near_first(setup_with(all_around()), {.strategy = {.look_early = false}});
  HarmonicPlanner faithful(setup_with(all_around()), {.strategy = HarmonicStrategy::faithful()});
  const auto seeks_the_scrap = [](const Plan& plan) {
    return std::find(plan.sought.begin(), plan.sought.end(), VoxelIndex{4, -2, 5}) != plan.sought.end();
  };
  EXPECT_TRUE(seeks_the_scrap(near_first.plan(map, current)));
  EXPECT_FALSE(seeks_the_scrap(faithful.plan(map, current)));
}

// Descent in any field would end there.
TEST(HarmonicPlanner, OnePlaceToGoNeedsNoField) {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{-1, -1, -1}, {21, 17, 13}}, [&](const VoxelIndex& cell) {
    const bool inside = VoxelBox{{0, 0, 0}, {20, 16, 12}}.contains(cell);
    map.set(cell, inside || cell == VoxelIndex{20, 11, 5} ? Occupancy::Free : Occupancy::Occupied);
  });
  const Pose current = pose_looking({0.5, 0.5, 0.5}, 0.0);
  const PlannerSetup setup = setup_with(all_around());
  HarmonicStrategy strategy;
  for (const bool shortest_way : {true, false}) {
    strategy.shortest_way = shortest_way;
    HarmonicPlanner planner(setup, {.strategy = strategy});
    const Plan plan = planner.plan(map, current);
    ASSERT_EQ(plan.outcome, Outcome::Move) << plan.reason;
    expect_admitted(map, *setup.platform, current, plan);
    EXPECT_EQ(plan.sought, std::vector<VoxelIndex>({{21, 11, 5}}));
    EXPECT_EQ(planner.field().has_value(), !shortest_way);
  }
}

// A height band of one cell gives a problem in the plane, as in the experiments of the paper.
TEST(HarmonicPlanner, APlatformThatKeepsItsHeightSolvesInThePlane) {
  const OccupancyMap map = box_with_opening();
  const Pose current = pose_looking({0.5, 0.5, 1.1}, 0.0);
  const PlannerSetup setup =
      setup_with(all_around(), {.radius_m = 0.15, .min_height_m = 1.05, .max_height_m = 1.15, .yaw_only = true});
  HarmonicPlanner planner(setup, {.strategy = HarmonicStrategy::faithful()});
  const Plan plan = planner.plan(map, current);
  ASSERT_EQ(plan.outcome, Outcome::Move) << plan.reason;
  expect_admitted(map, *setup.platform, current, plan);
  ASSERT_TRUE(planner.field());
  const LaplaceDomain& domain = planner.field()->potential.domain();
  domain.for_each_cell([](const VoxelIndex& cell) { EXPECT_EQ(cell.z, 5); });
  EXPECT_GT(domain.cell_count(), 200U);
  for (const Pose& pose : plan.path) {
    EXPECT_NEAR(pose.translation().z(), 1.1, 1e-9);
    EXPECT_NEAR(optical_axis(pose).z(), 0.0, 1e-9);
  }
}

GridWorld two_rooms() {
  GridWorld world{{0.2}, VoxelGrid<std::uint8_t>({{0, 0, 0}, {30, 14, 10}}, 0)};
  for_each_cell(world.occupied.box(), [&](const VoxelIndex& cell) {
    const bool wall = cell.x == 14 && !(cell.y >= 8 && cell.y < 12 && cell.z >= 1 && cell.z < 7);
    const bool pillar = cell.x >= 20 && cell.x < 22 && cell.y >= 4 && cell.y < 6;
    world.occupied[cell] = wall || pillar ? 1 : 0;
  });
  return world;
}

void explore(const RangeSensor& sensor, std::size_t most_views) {
  const GridWorld world = two_rooms();
  const PlannerSetup setup = setup_with(sensor);
  HarmonicPlanner planner(setup);
  OccupancyMap map({.resolution_m = world.frame.size_m});
  Pose pose = pose_looking({0.9, 0.9, 0.9}, 0.5);
  map.assume_free(setup.platform->body_box(pose));
  Plan plan;
  std::size_t views = 0;
  for (; views < most_views; ++views) {
    map.insert(world.scan(sensor, pose));
    plan = planner.plan(map, pose);
    if (plan.outcome != Outcome::Move) {
      break;
    }
    expect_admitted(map, *setup.platform, pose, plan);
    pose = plan.goal.pose;
  }
  EXPECT_EQ(plan.outcome, Outcome::Explored) << plan.reason;
  EXPECT_LT(views, most_views);
  std::size_t missed = 0;
  std::size_t free = 0;
  for_each_cell(world.occupied.box(), [&](const VoxelIndex& cell) {
    if (!world.blocked(cell)) {
      ++free;
      missed += map.at(cell) == Occupancy::Free ? 0U : 1U;
    }
  });
  EXPECT_GT(free, 3500U);
  EXPECT_LE(missed, free / 100) << views << " views, left " << plan.leftover.unobservable << " unobservable, "
                                << plan.leftover.unreachable << " unreachable";
}

TEST(HarmonicPlanner, ExploresTwoRoomsLookingAllAround) { explore(all_around(), 60); }

TEST(HarmonicPlanner, ExploresTwoRoomsThroughANarrowView) {
  explore(RangeSensor::pinhole(96, 72, 1.2, 0.95, 0.3, 4.0), 400);
}

TEST(HarmonicPlanner, RefusesOptionsByName) {
  const auto message = [](const PlannerSetup& setup, const HarmonicOptions& options) {
    try {
      HarmonicPlanner planner(setup, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const PlannerSetup setup = setup_with(all_around());
  EXPECT_EQ(message(setup, {}), "");
  EXPECT_NE(message(setup, {.survey = {.patience = 0}}).find("FrontierSurveyOptions::patience"), std::string::npos);
  EXPECT_NE(message(setup, {.strategy = {.detour_m = -1.0}}).find("HarmonicOptions::detour_m"), std::string::npos);
  EXPECT_NE(message(setup, {.field = {.tolerance = -1.0}}).find("tolerance"), std::string::npos);
  EXPECT_NE(message({.sensor = all_around(), .platform = nullptr}, {}).find("PlannerSetup::platform"),
            std::string::npos);
  HarmonicPlanner planner(setup);
  Pose bent = Pose::Identity();
  bent.linear() *= 2.0;
  EXPECT_THROW((void)planner.plan(box_with_opening(), bent), std::invalid_argument);
}

struct Travelled {
  Outcome outcome = Outcome::Move;
  double path_m = 0.0;
  std::size_t looks = 0;  // from the current place
  std::size_t plans = 0;
  std::size_t free_cells = 0;
};

// Follows a camera from the middle of a closed, empty room to the end of its run.
Travelled explore_room(const HarmonicStrategy& strategy) {
  constexpr VoxelBox kRoom{{0, 0, 0}, {20, 20, 12}};
  GridWorld world{VoxelFrame{0.2}, VoxelGrid<std::uint8_t>(kRoom)};
  const PlannerSetup setup = setup_with(RangeSensor::pinhole(64, 48, 1.0, 0.75, 0.4, 4.0));
  OccupancyMap map({.resolution_m = 0.2, .region = Box{{-0.2, -0.2, -0.2}, {4.2, 4.2, 2.6}}});
  Pose pose = pose_looking({2.1, 2.1, 1.3}, 0.0);
  map.assume_free(Box{{1.75, 1.75, 0.95}, {2.45, 2.45, 1.65}});
  HarmonicPlanner planner(setup, {.strategy = strategy});
  Travelled run;
  for (int view = 0; view < 400 && run.outcome == Outcome::Move; ++view) {
    map.insert(world.scan(setup.sensor, pose));
    const Plan plan = planner.plan(map, pose);
    run.outcome = plan.outcome;
    if (plan.outcome == Outcome::Move) {
      expect_admitted(map, *setup.platform, pose, plan);
      run.path_m += length_m(plan);
      run.looks += length_m(plan) < 1e-9 ? 1U : 0U;
      ++run.plans;
      pose = plan.goal.pose;
    }
  }
  run.free_cells = map.counts().free;
  return run;
}

// State kept between plans follows the map: a planner that gets a new copy each time gives the same plans.
TEST(HarmonicPlanner, KeepsNothingThatTheMapHasOutgrown) {
  constexpr VoxelBox kRoom{{0, 0, 0}, {16, 16, 10}};
  GridWorld world{VoxelFrame{0.2}, VoxelGrid<std::uint8_t>(kRoom)};
  const PlannerSetup setup = setup_with(RangeSensor::pinhole(64, 48, 1.0, 0.75, 0.4, 4.0));
  OccupancyMap map({.resolution_m = 0.2, .region = Box{{-0.2, -0.2, -0.2}, {3.4, 3.4, 2.2}}});
  Pose pose = pose_looking({1.5, 1.5, 1.1}, 0.0);
  map.assume_free(Box{{1.15, 1.15, 0.75}, {1.85, 1.85, 1.45}});
  HarmonicPlanner follows(setup);
  HarmonicPlanner starts_anew(setup);
  std::size_t views = 0;
  for (Outcome outcome = Outcome::Move; outcome == Outcome::Move && views < 100; ++views) {
    map.insert(world.scan(setup.sensor, pose));
    const OccupancyMap copy = map;
    const Plan plan = follows.plan(map, pose);
    const Plan same = starts_anew.plan(copy, pose);
    ASSERT_EQ(plan.outcome, same.outcome) << views;
    ASSERT_EQ(plan.path.size(), same.path.size()) << views;
    EXPECT_EQ(plan.goal.pose.matrix(), same.goal.pose.matrix()) << views;
    EXPECT_EQ(plan.sought, same.sought) << views;
    outcome = plan.outcome;
    pose = plan.goal.pose;
  }
  EXPECT_GE(views, 20U);
  EXPECT_LT(views, 100U);
}

TEST(HarmonicPlanner, ANarrowSensorLooksAllAroundBeforeItMovesOn) {
  const Travelled turning = explore_room({});
  const Travelled moving = explore_room({.look_again_m3 = std::numeric_limits<double>::infinity()});
  EXPECT_EQ(turning.outcome, Outcome::Explored);
  EXPECT_GT(2 * turning.looks, turning.plans);
  EXPECT_LT(turning.path_m, 0.6 * moving.path_m);
  EXPECT_GE(turning.free_cells, 4700U) << "of 4800";
}

}  // namespace
}  // namespace vantage
