// SPDX-License-Identifier: MIT
// The contract of ExplorationPlanner for every planner, in worlds small enough to verify each claim exhaustively.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

#include "contract/cell_world.hpp"
#include "support/every_planner.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

using testing::CellWorld;
using testing::Furniture;

constexpr std::size_t kMaxViews = 120;
constexpr std::uint32_t kSeeds = test::kSanitized ? 1 : 3;

RangeSensor all_round() {
  RangeSensor sensor = RangeSensor::spherical(180, 90, 2 * std::numbers::pi, std::numbers::pi, 0.0, 3.0);
  sensor.reports_no_return = true;
  return sensor;
}

RangeSensor camera() {
  RangeSensor sensor = RangeSensor::pinhole(96, 72, 1.2, 0.95, 0.1, 6.0);
  sensor.reports_no_return = true;
  return sensor;
}

bool same(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

bool same(const Plan& a, const Plan& b) {
  return a.outcome == b.outcome && a.leftover == b.leftover && same(a.goal.pose, b.goal.pose) &&
         a.goal.utility == b.goal.utility && a.path.size() == b.path.size() &&
         std::equal(a.path.begin(), a.path.end(), b.path.begin(),
                    [](const Pose& p, const Pose& q) { return same(p, q); });
}

/// Exhaustive search over reachable cells and unknown neighbours of frontier cells. Contested cells block sight.
bool anything_observable(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                         const Pose& current) {
  const ReachableSpace space(map, platform, current);
  for (const VoxelIndex& frontier : frontier_cells(map)) {
    for (const VoxelIndex& step : kFaceNeighbours) {
      const VoxelIndex unknown = frontier + step;
      if (!map.in_region(unknown) || map.at(unknown) != Occupancy::Unknown) {
        continue;
      }
      for (const VoxelIndex& from : space.cells()) {
        const Eigen::Vector3d line = map.frame().centre_of(unknown) - map.frame().centre_of(from);
        if (line.norm() < sensor.min_range_m || line.norm() > sensor.max_range_m) {
          continue;
        }
        bool in_sight = true;
        for (const VoxelIndex& cell :
             VoxelRay(map.frame(), map.frame().centre_of(from), map.frame().centre_of(unknown))) {
          in_sight = in_sight && (cell == unknown || map.at(cell) == Occupancy::Free);
        }
        if (in_sight) {
          return true;
        }
      }
    }
  }
  return false;
}

struct ContractCase {
  std::string planner;
  bool narrow = false;
};

void PrintTo(const ContractCase& setting,
             std::ostream* out) {  // NOLINT(readability-identifier-naming): GoogleTest's name
  *out << setting.planner << (setting.narrow ? ", camera" : ", all round");
}

/// A robot in a world, with a minimal host.
class Robot {
 public:
  Robot(const ContractCase& setting, Furniture furniture, std::uint32_t seed, std::size_t max_bytes = 0)
      : world_(testing::make_cell_world(furniture, seed)),
        sensor_(setting.narrow ? camera() : all_round()),
        platform_(std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1, .margin_m = 0.0})),
        map_({.resolution_m = world_.frame.size_m,
              .region = world_.frame.box_of(world_.solid.box()),
              .max_bytes = max_bytes}),
        pose_(pose_looking(world_.frame.centre_of(world_.start), 0.3)) {
    map_.assume_free(platform_->body_box(pose_));
    look();
  }

  [[nodiscard]] PlannerSetup setup(int threads = 1) const { return {sensor_, platform_, 7, threads}; }
  void look() { map_.insert(testing::scan_cells_of(world_, sensor_, pose_)); }
  void go(const Plan& plan) {
    pose_ = plan.goal.pose;
    look();
  }
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] const Platform& platform() const { return *platform_; }
  [[nodiscard]] const RangeSensor& sensor() const { return sensor_; }

 private:
  CellWorld world_;
  RangeSensor sensor_;
  std::shared_ptr<const FreeFlyer> platform_;
  OccupancyMap map_;
  Pose pose_;
};

class PlannerContract : public ::testing::TestWithParam<ContractCase> {
 protected:
  /// Runs to the end in each world and calls `check(robot, planner, plan)` after each plan. Returns the number of
  /// plans.
  template <class Check>
  std::size_t in_every_world(Check&& check) {
    std::size_t plans = 0;
    for (const Furniture furniture : {Furniture::Rooms, Furniture::Pillars, Furniture::Boxes}) {
      for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        Robot robot(GetParam(), furniture, seed);
        const auto planner = make_planner(GetParam().planner, robot.setup());
        std::size_t views = 0;
        for (; views < kMaxViews; ++views) {
          const Plan plan = planner->plan(robot.map(), robot.pose());
          ++plans;
          check(robot, *planner, plan);
          if (plan.outcome != Outcome::Move || HasFatalFailure()) {
            break;
          }
          robot.go(plan);
        }
        EXPECT_LT(views, kMaxViews) << "the run does not end by itself";
      }
    }
    return plans;
  }
};

TEST_P(PlannerContract, ThePathLeadsFromHereToTheGoalThroughAdmittedPoses) {
  std::size_t poses = 0;
  const std::size_t plans = in_every_world([&](const Robot& robot, ExplorationPlanner&, const Plan& plan) {
    if (plan.outcome != Outcome::Move) {
      EXPECT_TRUE(plan.path.empty());
      return;
    }
    ASSERT_GE(plan.path.size(), 2U);
    EXPECT_TRUE(same(plan.path.front(), robot.pose()));
    EXPECT_TRUE(same(plan.path.back(), plan.goal.pose));
    EXPECT_TRUE(robot.platform().admits(robot.map(), plan.goal.pose));
    for (std::size_t i = 1; i < plan.path.size(); ++i) {
      for (int s = 0; s <= 20; ++s) {
        Pose between = plan.path[i];
        between.translation() =
            plan.path[i - 1].translation() + s / 20.0 * (plan.path[i].translation() - plan.path[i - 1].translation());
        ASSERT_TRUE(robot.platform().admits(robot.map(), between));
        ++poses;
      }
    }
  });
  EXPECT_GE(plans, 3U * kSeeds * 2U);
  EXPECT_GT(poses, 130U * kSeeds);
}

TEST_P(PlannerContract, ItSaysExploredExactlyWhenNothingObservableIsLeft) {
  std::size_t explored = 0;
  in_every_world([&](const Robot& robot, ExplorationPlanner&, const Plan& plan) {
    EXPECT_NE(plan.outcome, Outcome::Blocked) << plan.reason;
    EXPECT_EQ(plan.outcome == Outcome::Explored,
              !anything_observable(robot.map(), robot.platform(), robot.sensor(), robot.pose()));
    explored += plan.outcome == Outcome::Explored ? 1 : 0;
  });
  EXPECT_EQ(explored, 3U * kSeeds);
}

/// A new map, of another origin, with the same cells and log-odds.
OccupancyMap rebuilt(const OccupancyMap& map) {
  OccupancyMap other(map.options());
  map.for_each_known([&](const VoxelIndex& cell, Occupancy) { other.set_log_odds(cell, *map.log_odds(cell)); });
  return other;
}

// TriedViews belongs to one map and its copies, so for another map a planner behaves like a new one.
TEST_P(PlannerContract, APlannerMadeNowAgreesWithOneThatFollowedAnotherMap) {
  std::unique_ptr<ExplorationPlanner> follower;
  const std::size_t plans = in_every_world([&](const Robot& robot, ExplorationPlanner&, const Plan&) {
    if (!follower) {
      follower = make_planner(GetParam().planner, robot.setup());
    }
    const OccupancyMap copy = rebuilt(robot.map());
    EXPECT_TRUE(same(follower->plan(copy, robot.pose()),
                     make_planner(GetParam().planner, robot.setup())->plan(copy, robot.pose())));
  });
  EXPECT_GE(plans, 3U * kSeeds * 2U);
}

// A robot that starts again from its saved map: the copy has the cells and the revision of the map.
TEST_P(PlannerContract, APlannerMadeNowGoesOnWithTheMemoryOfAnother) {
  const std::size_t plans = in_every_world([&](const Robot& robot, ExplorationPlanner& planner, const Plan& plan) {
    const OccupancyMap copy(robot.map());
    const auto now = make_planner(GetParam().planner, robot.setup());
    now->recall(copy, planner.memory());
    EXPECT_FALSE(now->memory().empty());
    EXPECT_EQ(now->memory(), planner.memory());
    EXPECT_TRUE(same(now->plan(copy, robot.pose()), plan));
  });
  EXPECT_GE(plans, 3U * kSeeds * 2U);
}

TEST_P(PlannerContract, PlanningTwiceAndOnMoreThreadsChangesNothing) {
  std::unique_ptr<ExplorationPlanner> on_threads;
  OccupancyMap::Revision last = 0;
  const std::size_t plans = in_every_world([&](const Robot& robot, ExplorationPlanner& planner, const Plan& plan) {
    EXPECT_TRUE(same(plan, planner.plan(robot.map(), robot.pose())));
    const OccupancyMap::Revision before = robot.map().revision();
    if (before <= last || !on_threads) {  // a new world
      on_threads = make_planner(GetParam().planner, robot.setup(2));
    }
    last = before;
    EXPECT_TRUE(same(plan, on_threads->plan(robot.map(), robot.pose())));
    EXPECT_EQ(robot.map().revision(), before);
  });
  EXPECT_GE(plans, 3U * kSeeds * 2U);
}

TEST_P(PlannerContract, ItFollowsTheMapAndNotItsAddress) {
  std::size_t plans = 0;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    Robot robot(GetParam(), Furniture::Rooms, seed);
    Robot elsewhere(GetParam(), Furniture::Boxes, seed);
    const auto planner = make_planner(GetParam().planner, robot.setup());
    const auto plans_as_one_made_now = [&](const OccupancyMap& map, const Pose& pose) {
      const Plan plan = planner->plan(map, pose);
      EXPECT_TRUE(same(plan, make_planner(GetParam().planner, robot.setup())->plan(map, pose)));
      ++plans;
      return plan;
    };
    OccupancyMap here = rebuilt(robot.map());
    plans_as_one_made_now(here, robot.pose());
    while (elsewhere.map().revision() <= robot.map().revision()) {
      elsewhere.look();
    }
    here = rebuilt(elsewhere.map());  // another map at the same address, with a higher revision
    plans_as_one_made_now(here, elsewhere.pose());
    auto moved = std::make_unique<OccupancyMap>(std::move(here));
    here = rebuilt(robot.map());
    plans_as_one_made_now(*moved, elsewhere.pose());
    moved.reset();
    robot.go(plans_as_one_made_now(here, robot.pose()));
    here = rebuilt(robot.map());
    plans_as_one_made_now(here, robot.pose());
  }
  EXPECT_EQ(plans, 5U * kSeeds);
}

TEST_P(PlannerContract, RefusesAPoseThatIsNone) {
  const Robot robot(GetParam(), Furniture::Boxes, 1);
  const auto planner = make_planner(GetParam().planner, robot.setup());
  Pose bad = robot.pose();
  bad.linear() *= 2.0;
  EXPECT_THROW((void)planner->plan(robot.map(), bad), std::invalid_argument);
  bad = robot.pose();
  bad.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)planner->plan(robot.map(), bad), std::invalid_argument);
  bad.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)planner->plan(robot.map(), bad), std::invalid_argument);
  bad = robot.pose();
  bad.linear().col(0) *= 1.0 + 2e-3;
  EXPECT_THROW((void)planner->plan(robot.map(), bad), std::invalid_argument);
}

// Poses slightly outside the region or in a wall, poses far away, and rotations with four digits occur in practice
// and must give a plan.
TEST_P(PlannerContract, AnyPoseThatARobotMayHaveGivesAPlan) {
  const Robot robot(GetParam(), Furniture::Boxes, 1);
  std::size_t plans = 0;
  const auto outcome_at = [&](const Pose& pose) {
    const Plan plan = make_planner(GetParam().planner, robot.setup())->plan(robot.map(), pose);
    EXPECT_FALSE(plan.reason.empty());
    EXPECT_EQ(plan.outcome == Outcome::Move, !plan.path.empty());
    ++plans;
    return plan.outcome;
  };
  Pose pose = robot.pose();
  pose.matrix() = (1e4 * pose.matrix()).array().round() / 1e4;
  ASSERT_FALSE(is_rigid(pose));
  EXPECT_EQ(outcome_at(pose), Outcome::Move);
  for (const double x_m : {-0.05, 0.05, 3.7}) {  // outside the region or in a wall: the robot may get away
    pose = robot.pose();
    pose.translation().x() = x_m;
    EXPECT_NE(outcome_at(pose), Outcome::Explored) << x_m;
  }
  for (const double x_m : {-1.0, -1e4, 1e6, -1e12, 1e300}) {
    pose = robot.pose();
    pose.translation().x() = x_m;
    EXPECT_EQ(outcome_at(pose), Outcome::Blocked) << x_m;
  }
  EXPECT_EQ(plans, 9U);
}

TEST_P(PlannerContract, SaysWhyItIsBlockedWhenThePlatformCannotMove) {
  OccupancyMap map({.resolution_m = 0.2});
  map.set({0, 0, 0}, Occupancy::Free);
  const PlannerSetup setup{all_round(), std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.5}), 1, 1};
  const Plan plan = make_planner(GetParam().planner, setup)->plan(map, pose_looking({0.1, 0.1, 0.1}, 0.0));
  EXPECT_EQ(plan.outcome, Outcome::Blocked);
  EXPECT_FALSE(plan.reason.empty());
  EXPECT_EQ(plan.leftover.unreachable, 1U);
}

// Runs to the end in a map with room for a part of the world. What could not be stored is counted as left over.
TEST_P(PlannerContract, InAFullMapItEndsAndCountsWhatItCouldNotLearn) {
  std::size_t runs = 0;
  for (const Furniture furniture : {Furniture::Rooms, Furniture::Pillars}) {
    Robot unlimited(GetParam(), furniture, 1);
    const auto planner = make_planner(GetParam().planner, unlimited.setup());
    for (std::size_t views = 0; views < kMaxViews; ++views) {
      const Plan plan = planner->plan(unlimited.map(), unlimited.pose());
      if (plan.outcome != Outcome::Move) {
        break;
      }
      unlimited.go(plan);
    }
    OccupancyMap one_brick;
    one_brick.set({0, 0, 0}, Occupancy::Free);
    OccupancyMap two_bricks = one_brick;
    two_bricks.set({8, 0, 0}, Occupancy::Free);
    const std::size_t brick_bytes = two_bricks.memory_bytes() - one_brick.memory_bytes();
    for (const std::size_t quarters : {2U, 3U}) {
      const std::size_t without = unlimited.map().brick_count() * (4 - quarters) / 4;
      ASSERT_GT(without, 0U);
      const std::size_t max_bytes = unlimited.map().memory_bytes() - without * brick_bytes;
      Robot robot(GetParam(), furniture, 1, max_bytes);
      const auto in_full = make_planner(GetParam().planner, robot.setup());
      Plan plan;
      std::size_t views = 0;
      for (; views < 10 * kMaxViews; ++views) {
        plan = in_full->plan(robot.map(), robot.pose());
        if (plan.outcome != Outcome::Move) {
          break;
        }
        ASSERT_TRUE(robot.platform().admits(robot.map(), plan.goal.pose));
        robot.go(plan);
      }
      EXPECT_LT(views, 10 * kMaxViews) << "the run does not end by itself";
      EXPECT_NE(plan.outcome, Outcome::Move);
      EXPECT_LE(robot.map().memory_bytes(), max_bytes);
      EXPECT_GT(robot.map().cells_refused(), 0U);
      EXPECT_GT(plan.leftover.in_vain + plan.leftover.unreachable + plan.leftover.unobservable, 0U) << plan.reason;
      ++runs;
    }
  }
  EXPECT_EQ(runs, 4U);
}

std::vector<ContractCase> settings() {
  std::vector<ContractCase> all;
  for (const std::string_view name : planner_names()) {
    all.push_back({std::string(name), false});
    all.push_back({std::string(name), true});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, PlannerContract, ::testing::ValuesIn(settings()),
                         [](const ::testing::TestParamInfo<ContractCase>& setting) {
                           return test::test_name(setting.param.planner +
                                                  (setting.param.narrow ? "_camera" : "_all_round"));
                         });

TEST(MakePlanner, ListsWhatThereIsWhenAskedForWhatThereIsNot) {
  const PlannerSetup setup{all_round(), std::make_shared<FreeFlyer>(), 1, 1};
  const auto message = [&](std::string_view name, const Settings& settings) -> std::string {
    try {
      (void)make_planner(name, setup, settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("best", {}).find("there is no planner 'best'; there are: "), std::string::npos);
  EXPECT_NE(message("frontier-gain", {{"hypothesis", "3"}}).find("has no setting 'hypothesis'"), std::string::npos);
  EXPECT_NE(message("frontier-gain", {{"hypotheses", "many"}}).find("must be a whole number"), std::string::npos);
  EXPECT_EQ(message("frontier-gain", {{"hypotheses", "0"}}),
            "FrontierGainOptions::hypotheses is 0, must be in [1, 1e+06]");
  EXPECT_EQ(message("frontier-gain", {{"hypotheses", "30"}, {"cost_per_m", "2.5"}}), "");
  EXPECT_EQ(message("frontier-void", {{"mode", "searching"}, {"views", "5"}}), "");
  EXPECT_NE(message("frontier-void", {{"mode", "hasty"}}).find("must be one of default, faithful, searching"),
            std::string::npos);
  EXPECT_THROW((void)make_planner("frontier-gain", {all_round(), nullptr, 1, 1}), std::invalid_argument);
  EXPECT_THROW((void)make_planner("frontier-gain", {all_round(), std::make_shared<FreeFlyer>(), 1, 0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace vantage
