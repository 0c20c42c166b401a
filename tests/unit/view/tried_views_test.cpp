// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/view/tried_views.hpp>
#include <vector>

namespace vantage {
namespace {

const VoxelIndex kHidden{5, 5, 5};

RangeSensor sees_all_around() {
  return RangeSensor::spherical(90, 45, 2.0 * std::numbers::pi, std::numbers::pi, 0.0, 6.0);
}

// Free cells in front of kHidden, which stays unknown.
OccupancyMap free_before_the_hidden() {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{-10, 0, 0}, {5, 10, 10}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  return map;
}

Pose at(const OccupancyMap& map, const VoxelIndex& cell, double yaw_rad = 0.0) {
  return pose_looking(map.frame().centre_of(cell), yaw_rad);
}

// A straight path of this length, without a turn.
std::vector<Pose> path_to(const Pose& goal, double length_m) {
  Pose start = goal;
  start.translation().y() -= length_m;
  return {start, goal};
}

// Plays planner and host: a view is planned, a scan without new information is inserted, the planner reviews.
void view_in_vain(TriedViews& tried, OccupancyMap& map, const Pose& goal, const Pose& taken_from) {
  tried.review(map, taken_from);
  EXPECT_TRUE(tried.expect(map, path_to(goal, 1.0), {kHidden}));
  map.confirm();
  tried.review(map, taken_from);
}

// By definition, in metres.
bool places_differ(const OccupancyMap& map, const VoxelIndex& seen, const VoxelIndex& a, const VoxelIndex& b) {
  const auto metres = [&](const VoxelIndex& p, const VoxelIndex& q) {
    return (map.frame().centre_of(p) - map.frame().centre_of(q)).norm();
  };
  return metres(a, b) > 0.5 * std::min(metres(a, seen), metres(b, seen)) + 1e-9;
}

TEST(TriedViews, EvidenceCountsFromPlacesThatDifferAsSeenFromTheCell) {
  const OccupancyMap map = free_before_the_hidden();
  std::mt19937 engine(5);
  std::uniform_int_distribution<std::int32_t> coordinate(-9, 4);
  const auto draw = [&] { return VoxelIndex{coordinate(engine), coordinate(engine), coordinate(engine)}; };
  std::size_t alike = 0;
  std::size_t different = 0;
  std::size_t given_up = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int patience = 1 + trial % 3;
    TriedViews tried(sees_all_around(), {.patience = patience});
    tried.review(map, at(map, {0, 5, 5}));
    std::vector<VoxelIndex> evidence;
    for (int look = 0; look < 4; ++look) {
      const VoxelIndex place = draw();
      const bool counts = std::all_of(evidence.begin(), evidence.end(), [&](const VoxelIndex& other) {
        return places_differ(map, kHidden, place, other);
      });
      EXPECT_EQ(tried.tried_from(kHidden, place), !counts);
      ++(counts ? different : alike);
      tried.in_vain(map, kHidden, place);
      if (counts) {
        evidence.push_back(place);
      }
      EXPECT_TRUE(tried.tried(kHidden));
      EXPECT_EQ(tried.gave_up(kHidden), evidence.size() >= static_cast<std::size_t>(patience));
      given_up += tried.gave_up(kHidden) ? 1U : 0U;
    }
    // The memory has a filter with one bit for all cells that are equal modulo a power of two. Cells that share a bit
    // must not be mixed up.
    for (const VoxelIndex& other : {VoxelIndex{0, 0, 1}, {128, 0, 0}, {0, -128, 0}, {0, 0, 64}, {64, 0, 0}}) {
      EXPECT_FALSE(tried.tried(kHidden + other));
      EXPECT_FALSE(tried.gave_up(kHidden + other));
    }
  }
  EXPECT_EQ(alike + different, 8000U);
  EXPECT_GT(alike, 1000U);
  EXPECT_GT(different, 3000U);
  EXPECT_GT(given_up, 3000U);
}

TEST(TriedViews, AViewThatArrivedAndResolvedNothingIsEvidenceAgainstWhatItSought) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.patience = 1});
  const Pose goal = at(map, {2, 5, 5});
  tried.review(map, goal);
  EXPECT_TRUE(tried.expect(map, path_to(goal, 1.0), {kHidden}));
  EXPECT_FALSE(tried.review(map, goal)) << "no scan was taken";
  EXPECT_FALSE(tried.tried(kHidden));
  map.confirm();
  EXPECT_TRUE(tried.review(map, goal));
  EXPECT_TRUE(tried.gave_up(kHidden));
  EXPECT_TRUE(tried.tried_from(kHidden, {2, 5, 5}));
  EXPECT_EQ(tried.size(), 1U);
}

TEST(TriedViews, ARobotHasArrivedWithinTheTolerances) {
  struct Case {
    double off_m;
    double off_rad;
    bool arrived;
  };
  for (const Case& one : {Case{0.29, 0.34, true}, {0.0, 0.0, true}, {0.31, 0.0, false}, {0.0, 0.36, false}}) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around(), {.goal_tolerance_m = 0.3, .goal_tolerance_rad = 0.35, .patience = 1});
    const Pose goal = at(map, {0, 5, 5});
    Pose there = pose_looking(goal.translation(), one.off_rad);
    there.translation().x() -= one.off_m;
    view_in_vain(tried, map, goal, there);
    EXPECT_EQ(tried.tried(kHidden), one.arrived) << one.off_m << " m, " << one.off_rad << " rad";
    map.confirm();  // a later scan at the goal itself gives the evidence
    tried.review(map, goal);
    EXPECT_TRUE(tried.tried(kHidden));
  }
  // The tolerance is at least one cell: a robot in the neighbouring cell cannot come nearer in the map.
  OccupancyMap map = free_before_the_hidden();
  TriedViews strict(sees_all_around(), {.goal_tolerance_m = 0.0, .patience = 1});
  view_in_vain(strict, map, at(map, {2, 5, 5}), at(map, {1, 5, 5}));
  EXPECT_TRUE(strict.tried(kHidden));
}

// Turned by less than the tolerance but more than the field of view: the cell was not looked at.
TEST(TriedViews, WhatWasNotInViewIsMissedFromThatGoalAndGivenUpLater) {
  OccupancyMap map = free_before_the_hidden();
  const RangeSensor narrow = RangeSensor::pinhole(60, 60, 0.4, 0.4, 0.1, 6.0);
  TriedViews tried(narrow, {.patience = 1});
  const VoxelIndex first{1, 5, 5};
  view_in_vain(tried, map, at(map, first), at(map, first, 0.3));
  EXPECT_TRUE(tried.tried_from(kHidden, first));
  EXPECT_FALSE(tried.tried_from(kHidden, {1, 5, 6})) << "not a look, so the next place may do better";
  EXPECT_FALSE(tried.gave_up(kHidden));
  const VoxelIndex second{1, 5, 9};
  const Eigen::Vector3d line = map.frame().centre_of(kHidden) - map.frame().centre_of(second);
  const Pose goal = pose_looking_along(map.frame().centre_of(second), line);
  const Pose turned = pose_looking(map.frame().centre_of(second), 0.0, std::asin(line.normalized().z()) - 0.3);
  view_in_vain(tried, map, goal, turned);
  EXPECT_TRUE(tried.gave_up(kHidden)) << "twice as many missed as would do in vain";
}

TEST(TriedViews, WhatAViewHopedForWasInVainOnlyIfItResolvedNoneOfIt) {
  constexpr VoxelIndex kOther{5, 6, 6};
  for (const bool one_resolved : {false, true}) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around(), {.patience = 1});
    const Pose goal = at(map, {2, 5, 5});
    tried.review(map, goal);
    EXPECT_TRUE(tried.expect(map, path_to(goal, 1.0), {kHidden}, {kOther, {5, 7, 7}}));
    map.set(one_resolved ? VoxelIndex{5, 7, 7} : VoxelIndex{0, 0, 0}, Occupancy::Free);
    tried.review(map, goal);
    EXPECT_TRUE(tried.gave_up(kHidden));
    EXPECT_EQ(tried.gave_up(kOther), !one_resolved);
  }
}

TEST(TriedViews, ALookAtAContestedCellIsStoredWhateverCameOfIt) {
  OccupancyMap map = free_before_the_hidden();
  const VoxelIndex cell{4, 5, 5};
  const VoxelIndex place{0, 5, 5};
  map.set_log_odds(cell, -map.log_odds_step());
  TriedViews tried(sees_all_around());
  tried.review(map, at(map, place));
  EXPECT_FALSE(tried.tried_at_distance(cell, place));
  ASSERT_TRUE(tried.expect(map, path_to(at(map, place), 1.0), {cell}));
  map.set(cell, Occupancy::Free);
  tried.review(map, at(map, place));
  TriedViews saved(sees_all_around());
  saved.recall(map, tried.text());
  map.set_log_odds(cell, -map.log_odds_step());
  tried.review(map, at(map, place));
  for (const TriedViews* memory : {&tried, &saved}) {
    EXPECT_TRUE(memory->tried_at_distance(cell, place));
    EXPECT_TRUE(memory->tried_at_distance(cell, {1, 6, 5}));
    EXPECT_FALSE(memory->tried_at_distance(cell, {3, 5, 5}));
    EXPECT_FALSE(memory->tried_at_distance(cell, {-4, 5, 5})) << "twice as far";
    EXPECT_FALSE(memory->gave_up(cell));
  }
}

TEST(TriedViews, AHostThatReportsIsBelieved) {
  const VoxelIndex place{0, 5, 5};
  const auto after = [&](GoalResult result, const VoxelIndex& robot) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around(), {.patience = 1});
    tried.review(map, at(map, robot));
    EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 1.0), {kHidden}));
    tried.report(result);
    map.confirm();
    tried.review(map, at(map, robot));
    return tried;
  };
  const VoxelIndex far{-8, 5, 5};
  EXPECT_TRUE(after(GoalResult::Reached, far).gave_up(kHidden));
  EXPECT_FALSE(after(GoalResult::Reached, far).rests(place));
  EXPECT_FALSE(after(GoalResult::Failed, place).gave_up(kHidden)) << "though it is there";
  EXPECT_TRUE(after(GoalResult::Failed, place).rests(place));
  EXPECT_FALSE(after(GoalResult::Preempted, place).tried(kHidden));
  EXPECT_FALSE(after(GoalResult::Preempted, place).any_rests());
}

// A robot that gives up before it moves has no new scan.
TEST(TriedViews, AFailureNeedsNoScanToCount) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const VoxelIndex place{0, 5, 5};
  tried.review(map, at(map, {-8, 5, 5}));
  EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 1.0), {kHidden}));
  tried.report(GoalResult::Failed);
  tried.review(map, at(map, {-8, 5, 5}));
  EXPECT_TRUE(tried.rests(place));
}

// A goal is asked for while the rest of the path, or of the turn at its end, gets shorter; then twice at most.
TEST(TriedViews, AGoalThatTheRobotComesNoNearerToRests) {
  const VoxelIndex place{2, 5, 5};
  const auto asked_for = [&](double way_m, double shorter_m, double turn_rad, double smaller_rad) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    int times = 0;
    for (; times < 20; ++times) {
      tried.review(map, at(map, {-8, 5, 5}));
      std::vector<Pose> path = path_to(at(map, place), way_m - shorter_m * times);
      path.front() = pose_looking(path.front().translation(), turn_rad - smaller_rad * times);
      if (!tried.expect(map, path, {kHidden})) {
        break;
      }
      EXPECT_FALSE(tried.any_rests());
      EXPECT_TRUE(tried.expect(map, path, {kHidden})) << "planning twice counts once";
      map.confirm();
    }
    EXPECT_EQ(tried.rests(place), times < 20);
    EXPECT_EQ(tried.places_given_up(), times < 20 ? 1U : 0U);
    EXPECT_FALSE(tried.try_resting_again()) << "what the robot comes no nearer to is not asked for at once";
    EXPECT_FALSE(tried.tried(kHidden)) << "it was never there";
    return times;
  };
  EXPECT_EQ(asked_for(5.0, 0.0, 0.0, 0.0), 2);
  EXPECT_EQ(asked_for(5.0, 0.005, 0.0, 0.0), 2) << "jitter";
  EXPECT_EQ(asked_for(5.0, -0.1, 0.0, 0.0), 2) << "it goes away";
  EXPECT_EQ(asked_for(5.0, 0.1, 0.0, 0.0), 20) << "it is on its way";
  EXPECT_EQ(asked_for(5.0, 0.0, 3.0, 0.1), 2) << "a turn far from the goal is no progress";
  EXPECT_EQ(asked_for(5.0, 0.1, 1.0, -0.1), 20) << "nor the opposite";
  EXPECT_EQ(asked_for(0.1, 0.0, 3.0, 0.1), 20) << "it turns at the goal";
  EXPECT_EQ(asked_for(0.1, 0.0, 3.0, 0.0), 2);
}

// A place that was asked for before, from nearer by, is no failure while the robot comes from far away: the view in
// between has served its purpose.
TEST(TriedViews, AViewThatServedItsPurposeStartsAnew) {
  for (const bool serves : {false, true}) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    const Pose far = at(map, {-8, 5, 5});
    tried.review(map, far);
    EXPECT_TRUE(tried.expect(map, path_to(at(map, {2, 5, 5}), 1.0), {kHidden}));
    map.confirm();
    tried.review(map, far);
    EXPECT_TRUE(tried.expect(map, path_to(at(map, {2, 5, 8}), 1.0), {{5, 8, 8}}));
    map.set(serves ? VoxelIndex{5, 8, 8} : VoxelIndex{5, 9, 9}, Occupancy::Free);
    int times = 0;
    for (; times < 20; ++times) {
      tried.review(map, far);
      if (!tried.expect(map, path_to(at(map, {2, 5, 5}), 5.0 - 0.1 * times), {kHidden})) {
        break;
      }
      map.confirm();
    }
    EXPECT_EQ(times, serves ? 20 : 1);
  }
}

// A robot that stops beside a goal would stop there again. One at the goal may look from there as often as there is
// something new to look at.
TEST(TriedViews, APlaceWithoutAWayRestsAtOnceAndForAWhile) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const VoxelIndex place{-5, 5, 5};
  const Pose here = at(map, {0, 5, 5});
  tried.review(map, here);
  tried.no_way_to(place);
  EXPECT_EQ(tried.places_given_up(), 1U);
  EXPECT_FALSE(tried.try_resting_again()) << "the way is as closed as before";
  EXPECT_FALSE(tried.is_stuck(here));
  for (int plan = 0; plan < 8; ++plan) {
    EXPECT_TRUE(tried.rests(place)) << plan;
    map.confirm();
    tried.review(map, here);
  }
  EXPECT_FALSE(tried.any_rests());
  EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 1.0), {kHidden}));
}

TEST(TriedViews, ARobotThatStopsOffTheGoalIsAskedTwice) {
  const auto asked_for = [](double off_m, bool reports) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    const Pose goal = at(map, {2, 5, 5});
    Pose robot = goal;
    robot.translation().x() -= off_m;
    int times = 0;
    for (; times < 10; ++times) {
      tried.review(map, robot);
      if (!tried.expect(map, {robot, goal}, {{5, times, 5}})) {
        break;
      }
      if (reports) {
        tried.report(GoalResult::Reached);
      }
      map.confirm();
    }
    return times;
  };
  EXPECT_EQ(asked_for(0.15, false), 2);
  EXPECT_EQ(asked_for(0.15, true), 10);
  EXPECT_EQ(asked_for(0.05, false), 10);
}

// The goal turns towards the robot from plan to plan. That brings the robot no nearer.
TEST(TriedViews, AGoalThatComesNearerIsNoProgressOfTheRobot) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const Pose robot = at(map, {2, 5, 5});
  int times = 0;
  for (; times < 10; ++times) {
    tried.review(map, robot);
    Pose goal = robot;
    goal.translation().x() += 0.15;
    goal.linear() = Eigen::AngleAxisd(1.0 - 0.05 * times, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    if (!tried.expect(map, {robot, goal}, {{5, 5, 5}})) {
      break;
    }
    map.confirm();
  }
  EXPECT_EQ(times, 2);
}

TEST(TriedViews, ARobotThatComesNoNearerToThreeGoalsIsStuck) {
  const auto stuck_after = [](int goals, double away_m, double drift_m, double then_moved_m) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    Pose here = at(map, {0, 5, 5});
    for (int number = 0; number < goals; ++number) {
      Pose goal = here;
      goal.translation() += away_m * Eigen::Vector3d(std::cos(2.0 * number), std::sin(2.0 * number), 0.0);
      for (int ask = 0; ask < 3; ++ask) {
        map.confirm();
        tried.review(map, here);
        EXPECT_EQ(tried.expect(map, {here, goal}, {kHidden}), ask < 2);
        here.translation().x() += ask < 2 ? 0.0 : drift_m;
      }
    }
    here.translation().x() += then_moved_m;
    return tried.is_stuck(here);
  };
  EXPECT_TRUE(stuck_after(3, 1.0, 0.0, 0.0));
  EXPECT_FALSE(stuck_after(2, 1.0, 0.0, 0.0)) << "two goals are no evidence";
  EXPECT_FALSE(stuck_after(3, 0.2, 0.0, 0.0)) << "within the tolerance the robot need not move";
  EXPECT_TRUE(stuck_after(3, 1.0, 0.02, 0.0)) << "a pose that jitters";
  EXPECT_FALSE(stuck_after(3, 1.0, 0.1, 0.0)) << "it creeps on";
  EXPECT_FALSE(stuck_after(3, 1.0, 0.0, 0.2)) << "it was freed";
}

// A host that reports refuses a whole part of the world. Each place gets its three tries, and that is the end.
TEST(TriedViews, HundredsOfPlacesAreGivenUpAfterThreeTriesOfEach) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.goal_tolerance_m = 0.0});
  const Pose robot = at(map, {-8, 5, 5});
  std::vector<int> tries(700);
  tried.review(map, robot);
  for (std::size_t next = 0; next < tries.size() && tries[next] < 10;) {
    const VoxelIndex place{3 * static_cast<std::int32_t>(next), 5, 5};
    if (tried.rests(place)) {
      ++next;
      next = next == tries.size() && tried.try_resting_again() ? 0 : next;
      continue;
    }
    ++tries[next];
    EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 5.0), {kHidden}));
    tried.report(GoalResult::Failed);
    map.confirm();
    tried.review(map, robot);
    next = 0;
  }
  EXPECT_EQ(tried.places_given_up(), tries.size());
  EXPECT_GE(*std::min_element(tries.begin(), tries.end()), 3);
  EXPECT_LE(*std::max_element(tries.begin(), tries.end()), 4);
}

TEST(TriedViews, NoPlaceRestsForLongOnceTheRunHasEnded) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const VoxelIndex place{2, 5, 5};
  const Pose robot = at(map, {-8, 5, 5});
  tried.review(map, robot);
  for (int failure = 0; failure < 3; ++failure) {
    EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 5.0), {kHidden}));
    tried.report(GoalResult::Failed);
    tried.review(map, robot);
    EXPECT_EQ(tried.try_resting_again(), failure < 2);
  }
  int waits = 0;
  for (; tried.rests(place) && waits < 500; ++waits) {
    tried.end_run();
    map.confirm();
    tried.review(map, robot);
  }
  EXPECT_EQ(waits, 8);
}

// By definition: the last eight places that failed once, and all within the tolerance of them.
TEST(TriedViews, WhatRestsIsWithinTheToleranceOfAFailure) {
  std::mt19937 engine(31);
  const auto draw = [&] {
    const auto coordinate = [&](std::int32_t side) {
      return static_cast<std::int32_t>(engine() % static_cast<std::uint32_t>(2 * side)) - side;
    };
    return VoxelIndex{coordinate(15), coordinate(15), coordinate(5)};
  };
  std::size_t at_rest = 0;
  for (const double tolerance_m : {0.0, 0.3, 0.45, 1.0}) {
    const OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around(), {.goal_tolerance_m = tolerance_m});
    tried.review(map, at(map, {}));
    std::vector<VoxelIndex> failed;
    for (std::int32_t i = 0; i < 40; ++i) {
      failed.push_back(draw() + VoxelIndex{0, 0, 100 * (i / 20)});  // no place fails twice within eight
      EXPECT_TRUE(tried.expect(map, path_to(at(map, failed.back()), 5.0), {}));
      tried.report(GoalResult::Failed);
      tried.review(map, at(map, {}));
      const std::vector<VoxelIndex> latest(failed.end() - std::min(i + 1, 8), failed.end());
      EXPECT_EQ(tried.resting().size(), latest.size());
      for (int question = 0; question < 500; ++question) {
        const VoxelIndex place = draw() + VoxelIndex{0, 0, 100 * (i / 20)};
        const bool rests = std::any_of(latest.begin(), latest.end(), [&](const VoxelIndex& other) {
          const VoxelIndex d = place - other;
          const double cells = std::sqrt(static_cast<double>(d.x * d.x + d.y * d.y + d.z * d.z));
          return cells <= std::max(tolerance_m / map.resolution_m(), 1.0);
        });
        EXPECT_EQ(tried.rests(place), rests);
        at_rest += rests ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(at_rest, 1000U);
}

// A robot that does not report may refuse one side and go elsewhere, so more goals are asked for on that side.
TEST(TriedViews, OnOneSideMoreGoalsTellThatARobotIsStuck) {
  const auto is_stuck_after = [](int goals) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    const Pose here = at(map, {0, 5, 5});
    for (int ask = 0; ask < 3; ++ask) {
      map.confirm();
      tried.review(map, here);
      for (int number = 0; number < goals; ++number) {
        Pose goal = here;
        const double heading_rad = 3.0 * number / goals;
        goal.translation() += 8.0 * Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0.0);
        EXPECT_EQ(tried.expect(map, {here, goal}, {kHidden}), ask < 2);
      }
    }
    return tried.is_stuck(here);
  };
  EXPECT_FALSE(is_stuck_after(3));
  EXPECT_FALSE(is_stuck_after(23));
  EXPECT_TRUE(is_stuck_after(24));
}

// One that reports is stuck if goals all around failed, not if one side of the world is refused.
TEST(TriedViews, ARobotThatFailsInAllDirectionsIsStuck) {
  const auto stuck_after = [](int goals, double spread_rad, bool is_level, double then_moved_m) {
    const OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    Pose here = at(map, {0, 5, 5});
    tried.review(map, here);
    for (int failure = 0; failure < 5 * goals; ++failure) {
      Pose goal = here;
      const double heading_rad = spread_rad * (failure * 7 % goals) / goals;
      const double up_m = is_level ? 0.0 : 0.1 * (failure % goals % 3);
      goal.translation() += Eigen::Vector3d(3.0 * std::cos(heading_rad), 3.0 * std::sin(heading_rad), up_m);
      EXPECT_TRUE(tried.expect(map, {here, goal}, {kHidden}));
      tried.report(GoalResult::Failed);
      tried.review(map, here);
    }
    EXPECT_EQ(tried.refused_directions(here).empty(), goals < 3);
    here.translation().x() += then_moved_m;
    return tried.is_stuck(here);
  };
  for (const bool is_level : {false, true}) {
    EXPECT_TRUE(stuck_after(30, 6.28, is_level, 0.0));
    EXPECT_TRUE(stuck_after(30, 5.0, is_level, 0.0));
    EXPECT_FALSE(stuck_after(30, 3.0, is_level, 0.0)) << "one side";
    EXPECT_FALSE(stuck_after(30, 1.0, is_level, 0.0));
    EXPECT_FALSE(stuck_after(20, 6.28, is_level, 0.0)) << "it may come by chance";
    EXPECT_FALSE(stuck_after(2, 6.28, is_level, 0.0));
    EXPECT_FALSE(stuck_after(30, 6.28, is_level, 0.2)) << "it was freed";
  }
}

// From afar, exactly through a corner between a free and an occupied cell: hardly a ray passes there.
TEST(TriedViews, ALookThroughACornerIsNoEvidence) {
  for (const bool is_free : {false, true}) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around(), {.patience = 1});
    const Pose goal = at(map, {0, 0, 5});  // on the diagonal of kHidden
    map.set({3, 2, 5}, is_free ? Occupancy::Free : Occupancy::Occupied);
    map.set({2, 3, 5}, Occupancy::Free);
    view_in_vain(tried, map, goal, goal);
    EXPECT_EQ(tried.gave_up(kHidden), is_free);
    EXPECT_TRUE(tried.tried_from(kHidden, {0, 0, 5})) << "it is not sought from there again";
  }
}

// Places close together do not differ, but a run does not end before two of them looked: the first ones of which none
// touches another.
TEST(TriedViews, ACellIsLookedCloselyAtFromCellsThatDoNotTouch) {
  const OccupancyMap map = free_before_the_hidden();
  std::mt19937 engine(12);
  std::uniform_int_distribution<std::int32_t> coordinate(0, 4);
  std::size_t closely = 0;
  std::size_t given_up = 0;
  for (int trial = 0; trial < 500; ++trial) {
    TriedViews tried(sees_all_around());
    std::vector<VoxelIndex> apart;
    const auto touches_one = [&](const VoxelIndex& place) {
      return std::any_of(apart.begin(), apart.end(), [&](const VoxelIndex& other) {
        return VoxelBox{other, other + VoxelIndex{1, 1, 1}}.grown(1).contains(place);
      });
    };
    for (int look = 0; look < 3; ++look) {
      const VoxelIndex place{-7, coordinate(engine), coordinate(engine)};
      EXPECT_EQ(tried.looked_from_beside(map, kHidden, place), touches_one(place));
      tried.in_vain(map, kHidden, place);
      if (!touches_one(place)) {
        apart.push_back(place);
      }
      EXPECT_EQ(tried.looked_closely(map, kHidden), apart.size() >= 2);
    }
    closely += tried.looked_closely(map, kHidden) ? 1U : 0U;
    given_up += tried.gave_up(kHidden) ? 1U : 0U;
  }
  EXPECT_GT(closely, 300U);
  EXPECT_LT(closely, 500U);
  EXPECT_EQ(given_up, 0U);
}

// A surface that was found later may close the line of a look. Then one from beside it counts, once.
TEST(TriedViews, ALookIsTakenAgainFromBesideOneWhoseLineWasClosed) {
  std::mt19937 engine(13);
  std::uniform_int_distribution<std::int32_t> coordinate(0, 4);
  int closed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    const VoxelIndex first{-7, coordinate(engine), coordinate(engine)};
    const VoxelIndex second = first + VoxelIndex{0, 1, 0};
    const auto line_from = [&](const VoxelIndex& place) {
      return VoxelRay(map.frame(), map.frame().centre_of(place), map.frame().centre_of(kHidden));
    };
    tried.in_vain(map, kHidden, first);
    EXPECT_TRUE(tried.looked_from_beside(map, kHidden, second));
    std::vector<VoxelIndex> line;
    for (const VoxelIndex& cell : line_from(first)) {
      line.push_back(cell);
    }
    const auto only_first = [&](const VoxelIndex& cell) {
      return cell != first && cell != kHidden &&
             line_from(second).all_touched([&](const VoxelIndex& other) { return other != cell; });
    };
    const auto closing = std::find_if(line.begin(), line.end(), only_first);
    if (closing == line.end()) {
      continue;
    }
    ++closed;
    map.set(*closing, Occupancy::Occupied);
    EXPECT_FALSE(tried.looked_from_beside(map, kHidden, second));
    EXPECT_FALSE(tried.looked_from_beside(map, kHidden, first));
    tried.in_vain(map, kHidden, second);
    EXPECT_TRUE(tried.looked_from_beside(map, kHidden, second));
    map.set(*closing, Occupancy::Free);
    EXPECT_TRUE(tried.looked_from_beside(map, kHidden, first)) << "it is not asked for twice";
  }
  EXPECT_GT(closed, 100);
}

// A line that touches a cell beside the hidden one, which is not free, suffices to go elsewhere but not to end a run.
TEST(TriedViews, ALookPastACellBesideItIsNoCloseLook) {
  for (const bool is_straight : {false, true}) {
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around(), {.patience = 1});
    const Pose goal = at(map, is_straight ? VoxelIndex{0, 5, 5} : VoxelIndex{0, 0, 5});
    view_in_vain(tried, map, goal, goal);
    EXPECT_TRUE(tried.gave_up(kHidden));
    EXPECT_EQ(tried.looked_closely(map, kHidden), is_straight);
    const VoxelIndex place = map.frame().cell_of(goal.translation());
    EXPECT_EQ(tried.looked_from_beside(map, kHidden, place), is_straight);
    view_in_vain(tried, map, goal, goal);
    EXPECT_TRUE(tried.looked_from_beside(map, kHidden, place)) << "once more was enough";
  }
}

// A robot that never gets where it is sent takes no clear look from a new place; the run ends nevertheless.
TEST(TriedViews, MissesEndEvenTheCloseLooks) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.goal_tolerance_m = 0.5});
  const Pose stops = at(map, {0, 5, 5});
  int misses = 0;
  for (std::int32_t y = 3; y < 8; ++y) {
    for (std::int32_t z = 4; z < 7 && !tried.looked_closely(map, kHidden); ++z, ++misses) {
      const Pose goal = at(map, {1, y, z});
      view_in_vain(tried, map, goal, stops);
      EXPECT_TRUE(tried.looked_from_beside(map, kHidden, {1, y, z}));
    }
  }
  EXPECT_TRUE(tried.looked_closely(map, kHidden));
  EXPECT_LE(misses, 8);
}

TEST(TriedViews, PlacesRestLongerAfterEveryFailureAndAreTriedThreeTimesInAll) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.goal_tolerance_m = 0.45});
  const VoxelIndex place{2, 5, 5};
  const Pose robot = at(map, {-8, 5, 5});
  tried.review(map, robot);
  for (const int rest : {8, 64, 512}) {
    EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 5.0), {kHidden}));
    tried.report(GoalResult::Failed);
    for (int plan = 0; plan < rest; ++plan) {
      map.confirm();
      tried.review(map, robot);
      EXPECT_TRUE(tried.rests(place)) << rest << ", plan " << plan;
      EXPECT_TRUE(tried.rests({2, 7, 5})) << "0.4 m beside it";
      EXPECT_FALSE(tried.rests({2, 5, 8})) << "0.6 m beside it";
      EXPECT_EQ(tried.places_given_up(), rest == 512 ? 1U : 0U);
    }
    if (rest == 512) {
      EXPECT_FALSE(tried.try_resting_again());
      EXPECT_TRUE(tried.rests(place));
    }
    map.confirm();
    tried.review(map, robot);
    EXPECT_FALSE(tried.any_rests());
    EXPECT_EQ(tried.places_given_up(), 0U);
  }
  TriedViews impatient(sees_all_around());
  impatient.review(map, robot);
  for (int failure = 1; failure <= 3; ++failure) {
    EXPECT_TRUE(impatient.expect(map, path_to(at(map, place), 5.0), {kHidden}));
    impatient.report(GoalResult::Failed);
    map.confirm();
    impatient.review(map, robot);
    EXPECT_TRUE(impatient.rests(place));
    EXPECT_EQ(impatient.try_resting_again(), failure < 3);
    EXPECT_EQ(impatient.rests(place), failure == 3);
  }
  EXPECT_EQ(impatient.places_given_up(), 1U);
}

TEST(TriedViews, AFailureThatBroughtTheRobotNearerIsNotCountedWithThoseBefore) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const auto fails_at = [&](double way_m) {
    EXPECT_TRUE(tried.expect(map, path_to(at(map, {2, 5, 5}), way_m), {kHidden}));
    tried.report(GoalResult::Failed);
    map.confirm();
    tried.review(map, at(map, {-8, 5, 5}));
    return tried.try_resting_again();
  };
  tried.review(map, at(map, {-8, 5, 5}));
  for (double way_m = 9.0; way_m > 1.0; way_m -= 1.0) {
    EXPECT_TRUE(fails_at(way_m)) << way_m;
  }
  EXPECT_FALSE(fails_at(2.0)) << "here it failed before";
}

TEST(TriedViews, AGoalThatWasReachedAfterAllHasNeverFailed) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const VoxelIndex place{2, 5, 5};
  const auto ask = [&](GoalResult result) {
    EXPECT_TRUE(tried.expect(map, path_to(at(map, place), 5.0), {}));
    tried.report(result);
    map.confirm();
    tried.review(map, at(map, {-8, 5, 5}));
  };
  tried.review(map, at(map, {-8, 5, 5}));
  ask(GoalResult::Failed);
  ask(GoalResult::Failed);
  ask(GoalResult::Reached);
  EXPECT_FALSE(tried.any_rests());
  ask(GoalResult::Failed);
  EXPECT_TRUE(tried.try_resting_again()) << "this was the first failure";
}

TEST(TriedViews, ForgetsWhenMoreOfTheNeighboursBecomesKnownNotWhenTheyChangeTheirMind) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.patience = 1});
  const Pose here = at(map, {2, 5, 5});
  view_in_vain(tried, map, here, here);
  ASSERT_TRUE(tried.gave_up(kHidden));
  for (const Occupancy mind : {Occupancy::Occupied, Occupancy::Free, Occupancy::Occupied}) {
    map.set({4, 5, 5}, mind);
    tried.review(map, here);
    EXPECT_TRUE(tried.gave_up(kHidden));
  }
  map.set({5, 6, 5}, Occupancy::Free);
  tried.review(map, here);
  EXPECT_FALSE(tried.gave_up(kHidden));
  EXPECT_EQ(tried.size(), 0U);

  tried.in_vain(map, kHidden, {2, 5, 5});
  EXPECT_EQ(tried.size(), 1U);
  map.set(kHidden, Occupancy::Occupied);
  tried.review(map, here);
  EXPECT_EQ(tried.size(), 0U) << "it is known";
}

TEST(TriedViews, KnowsTheGoalAheadUntilItIsReachedServedOrRefused) {
  std::size_t ends = 0;
  for (const std::string_view end : {"arrives", "sees what it sought", "fails", "is preempted", "gets another map"}) {
    SCOPED_TRACE(end);
    OccupancyMap map = free_before_the_hidden();
    TriedViews tried(sees_all_around());
    const Pose goal = at(map, {2, 5, 5});
    const Pose half_way = at(map, {2, 0, 5});
    tried.review(map, at(map, {2, -5, 5}));
    EXPECT_FALSE(tried.goal_ahead());
    ASSERT_TRUE(tried.expect(map, path_to(goal, 2.0), {kHidden}));
    map.confirm();
    tried.review(map, half_way);
    ASSERT_TRUE(tried.goal_ahead());
    EXPECT_EQ(tried.goal_ahead()->matrix(), goal.matrix());
    if (end == "sees what it sought") {
      map.set(kHidden, Occupancy::Free);
    } else if (end == "fails") {
      tried.report(GoalResult::Failed);
    } else if (end == "is preempted") {
      tried.report(GoalResult::Preempted);
    } else if (end == "gets another map") {
      map = free_before_the_hidden();
    }
    map.confirm();
    tried.review(map, end == "arrives" ? goal : half_way);
    EXPECT_FALSE(tried.goal_ahead());
    ++ends;
  }
  EXPECT_EQ(ends, 5U);
}

TEST(TriedViews, BelongsToOneMap) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.patience = 1});
  const Pose here = at(map, {2, 5, 5});
  view_in_vain(tried, map, here, here);
  EXPECT_TRUE(tried.expect(map, path_to(at(map, {0, 5, 5}), 1.0), {}));
  tried.report(GoalResult::Failed);
  map.confirm();
  tried.review(map, here);
  ASSERT_TRUE(tried.tried(kHidden) && tried.any_rests());
  const OccupancyMap another = free_before_the_hidden();
  EXPECT_FALSE(tried.review(another, here)) << "no scan is known to have been taken from here";
  EXPECT_EQ(tried.size(), 0U);
  EXPECT_FALSE(tried.any_rests());
  EXPECT_EQ(tried.scanned_from().size(), 1U);
}

// The size of the memory is limited, and the newest evidence remains.
TEST(TriedViews, IsBoundedWhateverHappens) {
  constexpr std::size_t kMost = std::size_t{1} << 18;
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around(), {.patience = 1});
  const VoxelIndex robot{-8, 5, 5};
  std::size_t largest = 0;
  std::int32_t latest = 0;
  for (std::int32_t plan = 0; plan < 4; ++plan) {
    tried.review(map, at(map, robot));
    EXPECT_LE(tried.size(), kMost);
    for (std::int32_t i = 0; i < 90'000; ++i) {
      latest = 100 + 90'000 * plan + i;
      tried.in_vain(map, {latest, 0, 0}, robot);
    }
    largest = std::max(largest, tried.size());
    map.confirm();
    EXPECT_LE(tried.scanned_from().size(), 64U);
  }
  EXPECT_GT(largest, kMost / 2) << "the bound was met";
  EXPECT_LE(largest, kMost + 90'000);
  EXPECT_TRUE(tried.gave_up({latest, 0, 0}));
  EXPECT_FALSE(tried.gave_up({100, 0, 0}));
}

// Places that failed stay longest, as text, too.
TEST(TriedViews, RemembersAFewThousandPlaces) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  const Pose robot = at(map, {-8, 5, 5});
  tried.review(map, robot);
  const auto ask = [&](std::int32_t number, bool fails) {
    EXPECT_TRUE(tried.expect(map, path_to(at(map, {3 * number, 5, 5}), 5.0), {}));
    if (fails) {
      tried.report(GoalResult::Failed);
    }
    tried.review(map, robot);
  };
  for (std::int32_t number = 0; number < 9000; ++number) {
    ask(number, number % 3 == 0);
  }
  const std::string text = tried.text();
  std::size_t places = 0;
  for (std::size_t line = text.find("\nplace "); line != std::string::npos; line = text.find("\nplace ", line + 1)) {
    ++places;
  }
  EXPECT_EQ(places, 4096U);
  EXPECT_NE(text.find("\nplace 0 5 5"), std::string::npos) << "it failed";
  EXPECT_EQ(text.find("\nplace 3 5 5"), std::string::npos) << "it did not";
}

// Random histories: what is saved as text and recalled answers every question as before, also after more history.
TEST(TriedViews, IsTheSameAfterItWasText) {
  std::mt19937 engine(11);
  std::uniform_int_distribution<std::int32_t> coordinate(-9, 12);
  const auto draw = [&] { return VoxelIndex{coordinate(engine), coordinate(engine), coordinate(engine)}; };
  std::size_t asked = 0;
  std::size_t given_up = 0;
  std::size_t at_rest = 0;
  for (int trial = 0; trial < 60; ++trial) {
    OccupancyMap map = free_before_the_hidden();
    const RangeSensor sensor = sees_all_around();
    TriedViews tried(sensor, {.goal_tolerance_m = 0.1});
    const auto go_on = [&](TriedViews& with, std::uint32_t seed) {
      std::mt19937 steps(seed);
      const auto step = [&] {
        return VoxelIndex{static_cast<std::int32_t>(steps() % 14) - 9, static_cast<std::int32_t>(steps() % 9),
                          static_cast<std::int32_t>(steps() % 9)};
      };
      for (int i = 0; i < 12; ++i) {
        const Pose here = at(map, step(), 0.1 * i);
        with.review(map, here);
        with.in_vain(map, {5 + static_cast<std::int32_t>(steps() % 4), 5, 5}, step());
        (void)with.expect(map, path_to(at(map, step()), 1.0 + i), {kHidden, {6, 5, 5}}, {{7, 5, 5}});
        with.report(std::array{GoalResult::Failed, GoalResult::Reached, GoalResult::Preempted}[steps() % 3]);
        map.confirm();
      }
      with.review(map, at(map, step()));
    };
    go_on(tried, static_cast<std::uint32_t>(engine()));
    TriedViews recalled(sensor, {.goal_tolerance_m = 0.1});
    const OccupancyMap copy(map);
    recalled.recall(copy, tried.text());
    EXPECT_EQ(recalled.text(), tried.text());
    const auto answer_alike = [&] {
      EXPECT_EQ(recalled.size(), tried.size());
      EXPECT_EQ(recalled.places_given_up(), tried.places_given_up());
      EXPECT_EQ(recalled.any_rests(), tried.any_rests());
      ASSERT_EQ(recalled.scanned_from().size(), tried.scanned_from().size());
      for (std::size_t i = 0; i < tried.scanned_from().size(); ++i) {
        EXPECT_EQ(recalled.scanned_from()[i].matrix(), tried.scanned_from()[i].matrix());
      }
      for (int i = 0; i < 300; ++i) {
        const VoxelIndex cell = i % 2 == 0 ? VoxelIndex{5 + i % 4, 5, 5} : draw();
        const VoxelIndex place = i % 3 == 0 ? map.frame().cell_of(tried.scanned_from().back().translation()) : draw();
        EXPECT_EQ(recalled.tried(cell), tried.tried(cell));
        EXPECT_EQ(recalled.tried_from(cell, place), tried.tried_from(cell, place));
        EXPECT_EQ(recalled.hoped_in_vain(cell, place), tried.hoped_in_vain(cell, place));
        EXPECT_EQ(recalled.gave_up(cell), tried.gave_up(cell));
        EXPECT_EQ(recalled.looked_closely(map, cell), tried.looked_closely(map, cell));
        EXPECT_EQ(recalled.looked_from_beside(map, cell, place), tried.looked_from_beside(map, cell, place));
        EXPECT_EQ(recalled.rests(place), tried.rests(place));
        given_up += tried.gave_up(cell) ? 1U : 0U;
        at_rest += tried.rests(place) ? 1U : 0U;
        ++asked;
      }
    };
    answer_alike();
    const auto more = static_cast<std::uint32_t>(engine());
    const OccupancyMap before(map);
    go_on(tried, more);
    map = before;
    go_on(recalled, more);
    answer_alike();
  }
  EXPECT_EQ(asked, 36'000U);
  EXPECT_GT(given_up, 1'000U);
  EXPECT_GT(at_rest, 50U);
}

TEST(TriedViews, RefusesTextThatIsNoMemoryAndKeepsItsOwn) {
  OccupancyMap map = free_before_the_hidden();
  TriedViews tried(sees_all_around());
  view_in_vain(tried, map, at(map, {3, 5, 5}), at(map, {3, 5, 5}));
  const std::string whole = tried.text();
  std::size_t refused = 0;
  const auto complaint = [&](const std::string& text) -> std::string {
    TriedViews other = tried;
    try {
      other.recall(map, text);
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(other.text(), whole);
      ++refused;
      return error.what();
    }
    return "";
  };
  const std::string head = "tried-views 1 0.2 7\n";
  EXPECT_EQ(complaint(whole), "");
  EXPECT_EQ(complaint(head), "");
  EXPECT_EQ(complaint(""), "a memory of tried views is empty");
  EXPECT_EQ(complaint("tried-views 2 0.2 7\n"), "line 1 of a memory of tried views: the version is not 1");
  EXPECT_NE(complaint("tried-views 1 0.1 7\n").find("cells of 0.100000 m, the map has"), std::string::npos);
  EXPECT_NE(complaint("tried-views 1 0.2 -7\n").find("a whole number was expected"), std::string::npos);
  EXPECT_NE(complaint(head + head).find("line 2 of"), std::string::npos);
  EXPECT_NE(complaint("cell 1 2 3 4 5\n").find("starts with 'tried-views'"), std::string::npos);
  EXPECT_NE(complaint(head + "cell 1 2 3 4\n").find("line 2 of a memory of tried views: 'cell' takes 5 numbers"),
            std::string::npos);
  EXPECT_NE(complaint(head + "cell 1 2 3 7 5\n").find("not above 6"), std::string::npos);
  EXPECT_NE(complaint(head + "cell 1 2 3.5 4 5\n").find("a whole number was expected"), std::string::npos);
  EXPECT_NE(complaint(head + "cell 1 2 2e9 4 5\n").find("a whole number was expected"), std::string::npos);
  EXPECT_NE(complaint(head + "missed 1 2 3\n").find("a look without a cell"), std::string::npos);
  EXPECT_NE(complaint(head + "place 1 2 3 nan 0 0 0\n").find("'nan' is not a finite number"), std::string::npos);
  EXPECT_NE(complaint(head + "scan 1 0 0 0 0 1 0 0 0 0 2 0\n").find("not a rigid transform"), std::string::npos);
  EXPECT_NE(complaint(head + "glass 1 2 3\n").find("'glass' is not an entry"), std::string::npos);
  EXPECT_NE(complaint(head + "\n").find("'' is not an entry"), std::string::npos);
  EXPECT_EQ(refused, 15U);
  // Any cut, and any changed byte, is a memory or is refused.
  for (std::size_t i = 0; i < whole.size(); ++i) {
    (void)complaint(whole.substr(0, i));
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] + 1);
    (void)complaint(changed);
  }
}

TEST(TriedViews, RefusesOptionsByName) {
  const auto message = [](const TriedViewsOptions& options) -> std::string {
    try {
      const TriedViews tried(sees_all_around(), options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message({}), "");
  EXPECT_EQ(message({.goal_tolerance_m = 0.0, .goal_tolerance_rad = 0.0, .patience = 1}), "");
  EXPECT_NE(message({.goal_tolerance_m = -0.1}).find("goal_tolerance_m is -0.1, must be >= 0"), std::string::npos);
  EXPECT_NE(message({.goal_tolerance_m = kNan}).find("goal_tolerance_m"), std::string::npos);
  EXPECT_NE(message({.goal_tolerance_rad = -0.1}).find("goal_tolerance_rad"), std::string::npos);
  EXPECT_NE(message({.goal_tolerance_rad = kNan}).find("goal_tolerance_rad"), std::string::npos);
  EXPECT_NE(message({.patience = 0}).find("patience is 0, must be >= 1"), std::string::npos);
}

}  // namespace
}  // namespace vantage
