// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vantage/planner/plan_check.hpp>
#include <vantage/robot/free_flyer.hpp>

namespace vantage {
namespace {

// A path through a hall of free cells of 0.2 m: from x = 0.3 to x = 1.9, then along y.
struct Walk {
  Walk() {
    for_each_cell({{0, 0, 0}, {12, 12, 5}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
    plan.outcome = Outcome::Move;
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.3, 0.5, 0.5), Eigen::Vector3d(1.1, 0.5, 0.5),
                                      Eigen::Vector3d(1.9, 0.5, 0.5), Eigen::Vector3d(1.9, 1.9, 0.5)}) {
      plan.path.push_back(pose_looking(at, 0.0));
    }
    plan.goal.pose = plan.path.back();
    plan.sought = {{12, 9, 2}, {12, 9, 3}};
  }
  [[nodiscard]] PlanCheck at(double x, double y) const {
    return check(plan, map, flyer, pose_looking({x, y, 0.5}, 1.0));
  }
  OccupancyMap map{{.resolution_m = 0.2}};
  FreeFlyer flyer{{.radius_m = 0.1, .margin_m = 0.0}};
  Plan plan;
};

TEST(PlanCheck, GoesOnAlongTheWayAndBesideIt) {
  const Walk walk;
  for (double x = 0.3; x < 1.9; x += 0.1) {
    EXPECT_EQ(walk.at(x, 0.5), PlanCheck::Good);
    EXPECT_EQ(walk.at(x, 0.8), PlanCheck::Good);
  }
  EXPECT_EQ(walk.at(1.9, 1.9), PlanCheck::Good) << "at the goal";
  EXPECT_EQ(walk.at(0.3, 1.1), PlanCheck::OffPath);
  EXPECT_EQ(check(walk.plan, walk.map, walk.flyer, pose_looking({0.3, 1.1, 0.5}, 0.0), 0.7), PlanCheck::Good);
}

TEST(PlanCheck, OnlyTheRestOfTheWayCanClose) {
  for (const bool behind : {false, true}) {
    Walk walk;
    walk.map.set({behind ? 2 : 7, 2, 2}, Occupancy::Occupied);
    EXPECT_EQ(walk.at(1.1, 0.5), behind ? PlanCheck::Good : PlanCheck::WayClosed);
    EXPECT_EQ(walk.at(1.9, 1.1), PlanCheck::Good);
    EXPECT_EQ(walk.at(0.3, 0.5), PlanCheck::WayClosed);
  }
}

TEST(PlanCheck, NothingIsLeftOnceAllIsKnownThatWasSought) {
  Walk walk;
  walk.map.set({12, 9, 2}, Occupancy::Free);
  EXPECT_EQ(walk.at(0.3, 0.5), PlanCheck::Good);
  walk.map.set({12, 9, 3}, Occupancy::Occupied);
  EXPECT_EQ(walk.at(0.3, 0.5), PlanCheck::NothingLeft);
  walk.plan.sought.clear();
  EXPECT_EQ(walk.at(0.3, 0.5), PlanCheck::Good) << "a planner that cannot say";
}

TEST(PlanCheck, WhatIsNoMoveIsGood) {
  Walk walk;
  for (const Outcome outcome : {Outcome::Explored, Outcome::Unreachable, Outcome::Blocked}) {
    walk.plan.outcome = outcome;
    EXPECT_EQ(walk.at(0.3, 1.9), PlanCheck::Good);
  }
}

}  // namespace
}  // namespace vantage
