// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/plan_check.hpp>
#include <vantage/planner/situation.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/grid_path.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr VoxelBox kHouse{{0, 0, 0}, {21, 11, 7}};
constexpr std::int32_t kWall = 9;
constexpr VoxelBox kDoor{{kWall, 4, 1}, {kWall + 1, 7, 6}};

RangeSensor round_about() {
  RangeSensor sensor = RangeSensor::spherical(180, 90, 2 * std::numbers::pi, std::numbers::pi, 0.0, 2.0);
  sensor.reports_no_return = true;
  return sensor;
}

/// A room whose cells are all known and, behind a wall with a closed door, a second room of which the cells `seen`
/// are free and the others unknown.
OccupancyMap two_rooms(const VoxelBox& seen) {
  OccupancyMap map({.resolution_m = 0.2, .region = VoxelFrame{0.2}.box_of(kHouse)});
  for_each_cell(VoxelBox{kHouse.lo, {kWall, kHouse.hi.y, kHouse.hi.z}}, [&](const VoxelIndex& cell) {
    const bool inside = VoxelBox{{1, 1, 1}, {kWall, kHouse.hi.y - 1, kHouse.hi.z - 1}}.contains(cell);
    map.set(cell, inside ? Occupancy::Free : Occupancy::Occupied);
  });
  for_each_cell(VoxelBox{{kWall, 0, 0}, {kWall + 1, kHouse.hi.y, kHouse.hi.z}},
                [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Occupied); });
  for_each_cell(seen, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  return map;
}

Pose in_the_first_room() { return pose_looking({0.9, 1.1, 0.7}, 0.0); }

PlannerSetup robot_with(const RangeSensor& sensor, double radius_m) {
  return {.sensor = sensor, .platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = radius_m})};
}

TEST(Situation, BehindAClosedDoorIsUnreachableUntilItOpens) {
  constexpr VoxelBox kSeen{{kWall + 1, 3, 1}, {kWall + 5, 8, 6}};
  OccupancyMap map = two_rooms(kSeen);
  Situation situation(robot_with(round_about(), 0.25));
  situation.sync(map, in_the_first_room());
  const std::optional<Plan> end = situation.end();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::Unreachable);
  EXPECT_GT(end->leftover.unreachable, 0U);
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  const std::size_t place = end->reason.find("around (");
  ASSERT_NE(place, std::string::npos) << end->reason;
  ASSERT_EQ(std::sscanf(end->reason.c_str() + place, "around (%lf, %lf, %lf)", &x, &y, &z), 3);
  EXPECT_TRUE(kSeen.contains(map.frame().cell_of({x, y, z}))) << end->reason;

  for_each_cell(kDoor, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  situation.sync(map, in_the_first_room());
  EXPECT_FALSE(situation.end());
  EXPECT_FALSE(situation.survey().targets.empty());
}

TEST(Situation, ContestedCellsInTheWayAreLookedAtFromDistancesThatDifferUntilTheyAreSettled) {
  constexpr double kRangeM = 1.0;
  OccupancyMap map = two_rooms({});
  for_each_cell(VoxelBox{{kWall + 1, 0, 0}, {kWall + 5, 11, 7}}, [&](const VoxelIndex& cell) {
    const bool inside = VoxelBox{{kWall + 1, 1, 1}, {kWall + 5, 10, 6}}.contains(cell);
    map.set(cell, inside ? Occupancy::Free : Occupancy::Occupied);
  });
  map.set_log_odds(kDoor, -map.log_odds_step());
  Situation situation(
      robot_with(RangeSensor::spherical(180, 90, 2 * std::numbers::pi, std::numbers::pi, 0.0, kRangeM), 0.25));
  Pose robot = in_the_first_room();
  std::unordered_map<VoxelIndex, std::vector<double>> looks_m;  // distances
  std::size_t looks = 0;
  std::optional<Plan> end;
  for (;;) {
    situation.sync(map, robot);
    end = situation.end();
    ASSERT_TRUE(end) << "no target is in range of the first room";
    if (end->outcome != Outcome::Move || ++looks > 100) {
      break;
    }
    ASSERT_FALSE(end->sought.empty());
    bool differs = false;
    for (const VoxelIndex& cell : end->sought) {
      EXPECT_TRUE(map.contested(cell));
      EXPECT_TRUE(kDoor.contains(cell));
      const double look_m = (map.frame().centre_of(cell) - end->goal.pose.translation()).norm();
      EXPECT_LE(look_m, kRangeM);
      differs = differs || std::none_of(looks_m[cell].begin(), looks_m[cell].end(), [&](double other_m) {
                  return std::max(look_m, other_m) < 2.0 * std::min(look_m, other_m) - 1e-9;
                });
      looks_m[cell].push_back(look_m);
    }
    EXPECT_EQ(check(*end, map, situation.platform(), robot), PlanCheck::Good);
    EXPECT_TRUE(differs);
    ASSERT_TRUE(situation.remember(*end, {}));
    robot = end->goal.pose;
    map.confirm();  // a scan that changes nothing
  }
  EXPECT_GE(looks, 2U);
  EXPECT_LE(looks, 20U);
  EXPECT_EQ(end->outcome, Outcome::Unreachable);
  EXPECT_NE(end->reason.find("around ("), std::string::npos) << end->reason;

  for_each_cell(kDoor, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  situation.sync(map, robot);
  EXPECT_FALSE(situation.end());
  EXPECT_FALSE(situation.survey().targets.empty());
}

TEST(Situation, ContestedCellsThatHideNothingAreNotLookedAt) {
  OccupancyMap map = two_rooms({});
  map.set(VoxelIndex{0, 5, 3}, Occupancy::Unknown);  // in a wall
  map.set_log_odds(VoxelBox{{6, 1, 1}, {9, 10, 6}}, -map.log_odds_step());
  map.set(VoxelIndex{1, 5, 3}, Occupancy::Occupied);
  map.set(VoxelIndex{20, 10, 6}, Occupancy::Free);  // a frontier that nothing sees
  Situation situation(robot_with(round_about(), 0.25));
  situation.sync(map, in_the_first_room());
  const std::optional<Plan> end = situation.end();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::Explored) << end->reason;
}

// A crack that no body fits through or into is no place that is cut off.
TEST(Situation, ACrackThatNoBodyFitsIntoIsNotUnreachable) {
  const OccupancyMap map = two_rooms({{kWall + 1, 3, 1}, {kWall + 5, 8, 2}});
  Situation situation(robot_with(round_about(), 0.25));
  situation.sync(map, in_the_first_room());
  const std::optional<Plan> end = situation.end();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::Explored);
  EXPECT_GT(end->leftover.unreachable, 0U);
}

TEST(Situation, AGoalAheadThatCanNoLongerBeReachedIsNone) {
  OccupancyMap map = two_rooms({{kWall + 1, 3, 1}, {kWall + 5, 8, 6}});
  for_each_cell(kDoor, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  Situation situation(robot_with(round_about(), 0.25));
  situation.sync(map, in_the_first_room());
  ASSERT_FALSE(situation.survey().targets.empty());
  Plan plan;
  plan.goal.pose = in_the_first_room();
  plan.goal.pose.translation().y() += 0.6;
  plan.path = {in_the_first_room(), plan.goal.pose};
  plan.sought = {situation.survey().targets.front().unknown};
  ASSERT_TRUE(situation.remember(plan, {}));
  map.confirm();
  situation.sync(map, in_the_first_room());
  ASSERT_TRUE(situation.goal_ahead());
  EXPECT_EQ(situation.goal_ahead()->matrix(), plan.goal.pose.matrix());
  map.set(map.frame().cell_of(plan.goal.pose.translation()), Occupancy::Occupied);
  situation.sync(map, in_the_first_room());
  EXPECT_TRUE(situation.tried().goal_ahead());
  EXPECT_FALSE(situation.goal_ahead());
}

// A long hall with blocks in the way. The exact search is the oracle.
TEST(Situation, AWayIsTheShortestOrNearlySoIfTheGoalIsFar) {
  std::mt19937 engine(23);
  std::size_t near = 0;
  std::size_t far = 0;
  double longer = 0.0;
  for (int world = 0; world < 4; ++world) {
    OccupancyMap map({.resolution_m = 0.2});
    for_each_cell({{0, 0, 0}, {420, 60, 5}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
    for (int block = 0; block < 36; ++block) {
      const VoxelIndex lo{static_cast<std::int32_t>(10 + engine() % 390), static_cast<std::int32_t>(engine() % 50),
                          0};
      for_each_cell({lo, lo + VoxelIndex{8, 22, 5}}, [&](const VoxelIndex& cell) {
        if (cell.y < 60) {
          map.set(cell, Occupancy::Occupied);
        }
      });
    }
    Situation situation(robot_with(round_about(), 0.25));
    situation.sync(map, pose_looking({1.0, 6.0, 0.5}, 0.0));
    const GridPaths exact(situation.reachable());
    const auto length_of = [&](const std::vector<VoxelIndex>& way) {
      double sum = 0.0;
      for (std::size_t i = 1; i < way.size(); ++i) {
        sum += (map.frame().centre_of(way[i]) - map.frame().centre_of(way[i - 1])).norm();
      }
      return sum;
    };
    for (int i = 0; i < 25; ++i) {
      const VoxelIndex goal = situation.reachable().cell(engine() % situation.reachable().size());
      const std::vector<VoxelIndex> way = situation.way_to(goal);
      const std::vector<VoxelIndex> shortest = exact.to(goal);
      ASSERT_FALSE(way.empty());
      EXPECT_EQ(way.front(), *situation.reachable().start());
      EXPECT_EQ(way.back(), goal);
      for (std::size_t at = 1; at < way.size(); ++at) {
        const VoxelIndex step = way[at] - way[at - 1];
        EXPECT_EQ(std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)}), 1);
        EXPECT_TRUE(situation.reachable().contains(way[at]));
      }
      const bool is_far =
          (map.frame().centre_of(goal) - map.frame().centre_of(*situation.reachable().start())).norm() > 60.0;
      ++(is_far ? far : near);
      longer += is_far ? length_of(way) / length_of(shortest) : 0.0;
      EXPECT_TRUE(is_far || way == shortest);
    }
    EXPECT_TRUE(situation.way_to({9, 9, 90}).empty());
    EXPECT_TRUE(situation.way_to({900, 9, 2}).empty());
  }
  EXPECT_GT(near, 30U);
  EXPECT_GT(far, 10U);
  EXPECT_LT(longer / static_cast<double>(far), 1.05);
}

TEST(Situation, ARoomThatIsKnownIsExplored) {
  const OccupancyMap map = two_rooms({});
  Situation situation(robot_with(round_about(), 0.25));
  situation.sync(map, in_the_first_room());
  const std::optional<Plan> end = situation.end();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::Explored);
  EXPECT_EQ(end->leftover, Leftover());
}

// A host whose controller fails every time gets other goals, each place three times at most, and an end that says so.
TEST(Situation, WhereTheRobotNeverArrivesIsUnreachable) {
  std::size_t planners = 0;
  for (const std::string_view name : planner_names()) {
    OccupancyMap map = two_rooms({{kWall + 1, 3, 1}, {kWall + 5, 8, 6}});
    for_each_cell(kDoor, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
    const std::unique_ptr<ExplorationPlanner> planner = make_planner(name, robot_with(round_about(), 0.25));
    Plan plan = planner->plan(map, in_the_first_room());
    std::size_t failures = 0;
    for (; plan.outcome == Outcome::Move && failures < 500; ++failures) {
      planner->report(map, in_the_first_room(), GoalResult::Failed);
      plan = planner->plan(map, in_the_first_room());
    }
    EXPECT_EQ(plan.outcome, Outcome::Unreachable) << name << ": " << plan.reason;
    EXPECT_NE(plan.reason.find("does not get to"), std::string::npos) << plan.reason;
    EXPECT_GE(failures, 3U);
    ++planners;
  }
  EXPECT_EQ(planners, planner_names().size());
}

// A robot that does not move and does not say so: no goal at which it is not is asked for a third time, not even the
// last one, before it has rested.
TEST(Situation, NoGoalIsAskedForAThirdTimeByARobotThatNeverMoves) {
  std::size_t asked = 0;
  std::size_t stuck = 0;  // planners that say so; with fewer than three goals, the places are unreachable
  for (const std::string_view name : planner_names()) {
    OccupancyMap map = two_rooms({{kWall + 1, 3, 1}, {kWall + 5, 8, 6}});
    for_each_cell(kDoor, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
    const PlannerSetup setup = robot_with(round_about(), 0.25);
    const std::unique_ptr<ExplorationPlanner> planner = make_planner(name, setup);
    std::vector<std::pair<std::size_t, Pose>> asks;
    const auto is_there = [&](const Pose& goal, const Pose& robot) {
      return (goal.translation() - robot.translation()).norm() <= setup.goal_tolerance_m &&
             optical_axis(goal).dot(optical_axis(robot)) >= std::cos(setup.goal_tolerance_rad);
    };
    std::size_t plans = 0;
    for (; plans < 1000; ++plans) {
      const Plan plan = planner->plan(map, in_the_first_room());
      if (plan.outcome != Outcome::Move) {
        const bool is_stuck = plan.outcome == Outcome::Blocked && plan.reason.find("free it") != std::string::npos;
        EXPECT_TRUE(is_stuck || plan.outcome == Outcome::Unreachable) << name << ": " << plan.reason;
        stuck += is_stuck ? 1U : 0U;
        break;
      }
      map.confirm();
      const Pose& goal = plan.goal.pose;
      if (!is_there(goal, in_the_first_room())) {
        asks.emplace_back(plans, goal);
        EXPECT_LE(std::count_if(asks.begin(), asks.end(),
                                [&](const auto& ask) {
                                  return ask.first + 8 > plans && ask.second.translation() == goal.translation() &&
                                         optical_axis(ask.second).dot(optical_axis(goal)) > 0.995;
                                }),
                  2)
            << name << ", plan " << plans;
      }
    }
    asked += asks.size();
    EXPECT_LT(plans, 1000U);
    std::size_t waits = 0;
    for (; waits < 10 && planner->plan(map, in_the_first_room()).outcome != Outcome::Move; ++waits) {
      map.confirm();
    }
    EXPECT_LT(waits, 10U) << "a host that waits is asked again";
  }
  EXPECT_GE(asked, 2 * planner_names().size());
  EXPECT_GT(stuck, 0U);
}

// A hall whose cells are unknown from 2 m and more from its middle. The robot stands nearer to one end.
struct Hall {
  Hall() {
    for_each_cell(VoxelFrame{0.2}.cells_centred_in({{-2.0, -1.0, 0.2}, {2.0, 1.0, 1.2}}),
                  [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  }
  OccupancyMap map{{.resolution_m = 0.2, .region = Box{{-6.0, -1.0, 0.2}, {6.0, 1.0, 1.2}}}};
  Pose pose = pose_looking({0.3, 0.1, 0.7}, 0.0);
};

// A host that refuses one end of the hall is sent to the other end before the run ends.
TEST(Situation, OneSideThatIsRefusedIsNoReasonToEnd) {
  std::size_t refused = 0;
  for (const bool reports : {false, true}) {
    for (const std::string_view name : planner_names()) {
      Hall hall;
      const std::unique_ptr<ExplorationPlanner> planner = make_planner(name, robot_with(round_about(), 0.25));
      Plan plan = planner->plan(hall.map, hall.pose);
      for (int plans = 0; plans < 60 && plan.outcome == Outcome::Move && plan.goal.pose.translation().x() > 0.3;
           ++plans) {
        if (reports) {
          planner->report(hall.map, hall.pose, GoalResult::Failed);
        }
        hall.map.confirm();
        plan = planner->plan(hall.map, hall.pose);
        ++refused;
      }
      EXPECT_EQ(plan.outcome, Outcome::Move) << name << ": " << plan.reason;
      EXPECT_LE(plan.goal.pose.translation().x(), 0.3) << name;
    }
  }
  EXPECT_GT(refused, 20U);
}

// A host that reports a failure for every goal is told soon that its robot does not move, with or without new scans,
// and again if it waits.
TEST(Situation, ARobotThatFailsToGoAnywhereIsBlocked) {
  std::size_t planners = 0;
  for (const bool scans : {false, true}) {
    for (const std::string_view name : planner_names()) {
      Hall hall;
      const std::unique_ptr<ExplorationPlanner> planner = make_planner(name, robot_with(round_about(), 0.25));
      const auto drive = [&] {
        int plans = 0;
        Plan plan = planner->plan(hall.map, hall.pose);
        for (; plan.outcome == Outcome::Move && plans < 500; ++plans) {
          planner->report(hall.map, hall.pose, GoalResult::Failed);
          if (scans) {
            hall.map.confirm();
          }
          plan = planner->plan(hall.map, hall.pose);
        }
        EXPECT_EQ(plan.outcome, Outcome::Blocked) << name << ": " << plan.reason;
        EXPECT_NE(plan.reason.find("free it"), std::string::npos) << name << ": " << plan.reason;
        return plans;
      };
      EXPECT_LT(drive(), 200) << name;
      int waits = 0;
      for (; waits < 40 && planner->plan(hall.map, hall.pose).outcome != Outcome::Move; ++waits) {
        hall.map.confirm();
      }
      EXPECT_LT(waits, 40) << "a host that waits is asked again";
      EXPECT_LT(drive(), 200) << name;
      ++planners;
    }
  }
  EXPECT_EQ(planners, 2 * planner_names().size());
}

// A robot between two obstacles that are known: there is nothing to declare free, but there is more to see.
TEST(Situation, ARobotThatIsHemmedInByTheKnownIsNotBlocked) {
  OccupancyMap map = two_rooms({{kWall + 1, 3, 1}, {kWall + 5, 8, 6}});
  for_each_cell(kDoor, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  const VoxelIndex here = map.frame().cell_of(in_the_first_room().translation());
  const VoxelBox around = VoxelBox{here, here + VoxelIndex{1, 1, 1}}.grown(3);
  for_each_cell(around, [&](const VoxelIndex& cell) {
    if (!VoxelBox{here, here + VoxelIndex{1, 1, 1}}.grown(2).contains(cell)) {
      map.set(cell, Occupancy::Occupied);
    }
  });
  Situation situation(robot_with(round_about(), 0.25));
  situation.sync(map, in_the_first_room());
  const std::optional<Plan> end = situation.end();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::Unreachable) << end->reason;
  EXPECT_NE(end->reason.find("around ("), std::string::npos) << end->reason;
}

// Nothing is known but the space that the body fills: a narrow sensor first looks in every direction.
TEST(Situation, ANarrowSensorTurnsOnTheSpotBeforeItIsBlocked) {
  std::size_t turns = 0;
  for (const double angle_rad : {0.5, 0.8, 1.2, 2.0}) {
    OccupancyMap map({.resolution_m = 0.2});
    for_each_cell(VoxelBox{{0, 0, 0}, {3, 3, 3}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
    Situation situation(robot_with(RangeSensor::pinhole(48, 36, angle_rad, 0.5, 0.5, 4.0), 0.2));
    Pose pose = pose_looking({0.3, 0.3, 0.3}, 0.4);
    std::vector<double> looked_at_rad{0.4};
    situation.sync(map, pose);
    std::optional<Plan> end = situation.end();
    while (end && end->outcome == Outcome::Move && looked_at_rad.size() < 40) {
      EXPECT_EQ(end->goal.pose.translation(), pose.translation());
      EXPECT_EQ(end->path.size(), 2U);
      EXPECT_TRUE(situation.remember(*end, {}));
      pose = end->goal.pose;
      looked_at_rad.push_back(std::atan2(optical_axis(pose).y(), optical_axis(pose).x()));
      map.confirm();
      situation.sync(map, pose);
      end = situation.end();
      ++turns;
    }
    ASSERT_TRUE(end);
    EXPECT_EQ(end->outcome, Outcome::Blocked);
    EXPECT_NE(end->reason.find("assume_free"), std::string::npos) << end->reason;
    for (double direction_rad = 0.0; direction_rad < 6.28; direction_rad += 0.05) {
      EXPECT_TRUE(std::any_of(
          looked_at_rad.begin(), looked_at_rad.end(),
          [&](double looked_rad) { return std::cos(looked_rad - direction_rad) >= std::cos(0.5 * angle_rad); }))
          << direction_rad << " with a view of " << angle_rad;
    }
    EXPECT_LE(static_cast<double>(looked_at_rad.size()), std::ceil(2 * std::numbers::pi / (0.8 * angle_rad)));
  }
  EXPECT_GT(turns, 20U);
}

}  // namespace
}  // namespace vantage
