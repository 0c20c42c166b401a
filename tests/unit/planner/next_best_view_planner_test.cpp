// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <contract/cell_world.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/candidate_views.hpp>

namespace vantage {
namespace {

using testing::CellWorld;

// A closed room, in cells of 5 cm, with a table and a branched object on it.
CellWorld table_world(std::uint32_t seed) {
  CellWorld world{VoxelFrame{0.05}, VoxelGrid<std::uint8_t>({{-30, -30, 0}, {30, 30, 44}}, 1), {}};
  std::mt19937 engine(seed);
  const auto fill = [&](const VoxelBox& box, std::uint8_t value) {
    for_each_cell(box, [&](const VoxelIndex& cell) { world.solid[cell] = value; });
  };
  fill({{-29, -29, 1}, {29, 29, 43}}, 0);
  fill({{-8, -8, 12}, {8, 8, 14}}, 1);
  fill({{-2, -2, 14}, {2, 2, 22}}, 1);
  for (int arm = 0; arm < 3; ++arm) {
    const auto at = [&](std::uint32_t span) { return static_cast<std::int32_t>(engine() % span); };
    const VoxelIndex lo{at(6) - 5, at(6) - 5, 15 + at(4)};
    fill({lo, lo + VoxelIndex{1 + at(5), 1 + at(5), 2}}, 1);
  }
  return world;
}

const Box kObject{{-0.3, -0.3, 0.7}, {0.3, 0.3, 1.15}};

struct RobotAtTable {
  explicit RobotAtTable(std::uint32_t seed)
      : world(table_world(seed)),
        map({.resolution_m = 0.05, .region = world.frame.box_of(world.solid.box())}),
        pose(pose_looking_along({-1.2, 0.1, 1.3}, {1.2, -0.1, -0.4})) {
    map.assume_free(platform->body_box(pose));
    look();
  }

  void look() { map.insert(testing::scan_cells_of(world, sensor, pose)); }
  [[nodiscard]] PlannerSetup setup(int threads = 1) const { return {sensor, platform, 7, threads}; }
  // Share of the object's faces towards free space whose cells are occupied in the map.
  [[nodiscard]] double coverage() const {
    std::size_t surface = 0;
    std::size_t known = 0;
    for_each_cell(map.frame().cells_centred_in(kObject), [&](const VoxelIndex& cell) {
      const bool is_open = std::any_of(kFaceNeighbours.begin(), kFaceNeighbours.end(),
                                       [&](const VoxelIndex& step) { return !world.is_solid(cell + step); });
      if (world.is_solid(cell) && is_open) {
        ++surface;
        known += map.at(cell) == Occupancy::Occupied ? 1U : 0U;
      }
    });
    return static_cast<double>(known) / static_cast<double>(surface);
  }

  CellWorld world;
  RangeSensor sensor = RangeSensor::pinhole(120, 90, 1.2, 0.95, 0.0, 4.0);
  std::shared_ptr<const FreeFlyer> platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.06});
  OccupancyMap map;
  Pose pose;
};

// The highest utility of all candidates, computed by uniform ray tracing.
double best_utility(const RobotAtTable& run, const NextBestViewOptions& options) {
  const ViewRays rays(run.sensor.rays_for(0.05));
  const UniformRayTracer uniform(run.map);
  double best = 0.0;
  for (const Pose& view :
       views_around(kObject.centre(), options.candidates.radii_m, options.candidates.subdivisions)) {
    if (run.platform->admits(run.map, view)) {
      const ViewEvaluation seen = uniform.evaluate(view, rays, run.map.frame().cells_centred_in(kObject));
      const double rho_m = run.platform->distance_m(run.pose, view);
      best = std::max(
          best, seen.occupied >= options.min_overlap_cells ? static_cast<double>(seen.unknown) / (1.0 + rho_m) : 0.0);
    }
  }
  return best;
}

TEST(NextBestViewPlanner, TakesTheBestViewUntilNoneSeesEnough) {
  std::size_t plans = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    RobotAtTable run(seed);
    const NextBestViewOptions options{
        .candidates = {.object = kObject, .radii_m = {0.8}, .subdivisions = 1, .aimed_candidates = 0},
        .min_overlap_cells = 5,
        .min_unknown_cells = 5};
    NextBestViewPlanner planner(run.setup(), options);
    std::size_t views = 0;
    Plan plan = planner.plan(run.map, run.pose);
    for (; views < 40 && plan.outcome == Outcome::Move; ++views) {
      if (views < 3) {  // while nothing can be given up yet
        EXPECT_DOUBLE_EQ(plan.goal.utility, best_utility(run, options));
      }
      EXPECT_GE(plan.sought.size(), options.min_unknown_cells);
      EXPECT_EQ(plan.path.front().matrix(), run.pose.matrix());
      EXPECT_EQ(plan.path.back().matrix(), plan.goal.pose.matrix());
      EXPECT_TRUE(run.platform->admits(run.map, plan.goal.pose));
      const Plan on_threads = NextBestViewPlanner(run.setup(3), options).plan(run.map, run.pose);
      if (views < 3) {
        EXPECT_EQ(on_threads.goal.pose.matrix(), plan.goal.pose.matrix());
      }
      const Plan again = planner.plan(run.map, run.pose);
      EXPECT_EQ(again.goal.pose.matrix(), plan.goal.pose.matrix());
      EXPECT_EQ(again.goal.utility, plan.goal.utility);
      run.pose = plan.goal.pose;
      run.look();
      plan = planner.plan(run.map, run.pose);
      ++plans;
    }
    EXPECT_EQ(plan.outcome, Outcome::Explored) << plan.reason;
    EXPECT_LT(views, 20U);
    EXPECT_GT(run.coverage(), 0.95);
  }
  EXPECT_GE(plans, 8U);
}

TEST(NextBestViewPlanner, CountsByTheMethodAskedFor) {
  RobotAtTable run(2);
  NextBestViewOptions options{.candidates = {.object = kObject, .radii_m = {0.8}, .subdivisions = 1},
                              .min_overlap_cells = 5,
                              .min_unknown_cells = 5};
  const Plan exact = NextBestViewPlanner(run.setup(), options).plan(run.map, run.pose);
  options.method = VisibilityMethod::Uniform;
  const Plan uniform = NextBestViewPlanner(run.setup(), options).plan(run.map, run.pose);
  EXPECT_EQ(exact.goal.pose.matrix(), uniform.goal.pose.matrix());
  EXPECT_EQ(exact.goal.utility, uniform.goal.utility);
  EXPECT_EQ(exact.sought, uniform.sought);
  options.method = VisibilityMethod::Hierarchical;
  NextBestViewPlanner planner(run.setup(), options);
  Plan plan = planner.plan(run.map, run.pose);
  EXPECT_GT(plan.goal.utility, exact.goal.utility) << "it counts rays, of which there are more than cells";
  std::size_t views = 0;
  for (; views < 40 && plan.outcome == Outcome::Move; ++views) {
    run.pose = plan.goal.pose;
    run.look();
    plan = planner.plan(run.map, run.pose);
  }
  EXPECT_EQ(plan.outcome, Outcome::Explored);
  EXPECT_GT(views, 1U);
  EXPECT_GT(run.coverage(), 0.9);
}

// Runs to the end and returns the number of views.
std::size_t reconstruct(RobotAtTable& run, ExplorationPlanner& planner, std::size_t least_sought) {
  Plan plan = planner.plan(run.map, run.pose);
  std::size_t views = 0;
  for (; views < 40 && plan.outcome == Outcome::Move; ++views) {
    EXPECT_TRUE(run.platform->admits(run.map, plan.goal.pose));
    EXPECT_GE(plan.sought.size(), least_sought);
    run.pose = plan.goal.pose;
    run.look();
    plan = planner.plan(run.map, run.pose);
  }
  EXPECT_EQ(plan.outcome, Outcome::Explored) << plan.reason;
  return views;
}

const Settings kAroundTheTable{
    {"object", "-0.3,-0.3,0.7,0.3,0.3,1.15"}, {"radii_m", "0.8"}, {"subdivisions", "1"}, {"aimed_candidates", "0"}};

// The same by the utility of the paper.
std::size_t reconstruct(RobotAtTable& run, Settings settings) {
  settings.merge(Settings(kAroundTheTable));
  settings.merge(Settings{{"min_unknown_cells", "5"}});
  return reconstruct(run, *make_planner("next-best-view", run.setup(), settings), 5);
}

TEST(NextBestViewPlanner, ReconstructsFromAnyCandidates) {
  const std::vector<Settings> candidates{
      {}, {{"radii_m", "0.6,0.8,1"}, {"subdivisions", "0"}}, {{"aimed_candidates", "80"}}};
  for (const Settings& settings : candidates) {
    double coverage = 0.0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      RobotAtTable run(seed);
      EXPECT_LT(reconstruct(run, settings), 10U);
      coverage += run.coverage() / 4.0;
    }
    EXPECT_GT(coverage, 0.97);
  }
}

// The box of the object is all that has to be said.
TEST(NextBestViewPlanner, ReconstructsFromADistanceThatFits) {
  for (const Settings& more : {Settings{}, Settings{{"min_unknown_cells", "5"}}}) {
    double coverage = 0.0;
    for (std::uint32_t seed = 501; seed <= 504; ++seed) {
      RobotAtTable run(seed);
      Settings settings{{"object", "-0.3,-0.3,0.7,0.3,0.3,1.15"}};
      settings.insert(more.begin(), more.end());
      EXPECT_LT(reconstruct(run, *make_planner("next-best-view", run.setup(), settings), 0), 15U);
      coverage += run.coverage() / 4.0;
    }
    EXPECT_GT(coverage, 0.97);
  }
}

// Aimed views see parts that views of the whole object miss. So the choice that is the default needs fewer views.
TEST(NextBestViewPlanner, SeesMoreFromAimedViewsByDefault) {
  double by_one_shell = 0.0;
  double by_aimed = 0.0;
  std::size_t views_of_one_shell = 0;
  std::size_t views_aimed = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const auto seen_by = [&](double& coverage, Settings settings) {
      settings.merge(Settings(kAroundTheTable));
      RobotAtTable run(seed);
      const std::size_t views = reconstruct(run, *make_planner("next-best-view", run.setup(), settings), 0);
      coverage += run.coverage() / 4.0;
      return views;
    };
    views_of_one_shell += seen_by(by_one_shell, {});
    views_aimed += seen_by(by_aimed, {{"aimed_candidates", "320"}});
  }
  EXPECT_GE(by_aimed, by_one_shell);
  EXPECT_LE(views_aimed, views_of_one_shell);
}

TEST(NextBestViewPlanner, DrawsAimedViewsForTheMapAlone) {
  RobotAtTable run(2);
  NextBestViewOptions options{.candidates = {.object = kObject, .subdivisions = -1, .aimed_candidates = 0},
                              .min_unknown_cells = 5};
  EXPECT_EQ(NextBestViewPlanner(run.setup(), options).plan(run.map, run.pose).outcome, Outcome::Explored);
  options.candidates.radii_m = {0.9};
  options.candidates.aimed_candidates = 100;
  NextBestViewPlanner follower(run.setup(), options);
  std::size_t plans = 0;
  for (Plan plan = follower.plan(run.map, run.pose); plans < 3 && plan.outcome == Outcome::Move; ++plans) {
    EXPECT_LE(plan.candidates.size(), 100U);
    EXPECT_EQ(plan.goal.pose.matrix(), follower.plan(run.map, run.pose).goal.pose.matrix());
    if (plans == 0) {  // while nothing can be given up yet
      const Plan alone = NextBestViewPlanner(run.setup(2), options).plan(run.map, run.pose);
      EXPECT_EQ(plan.goal.pose.matrix(), alone.goal.pose.matrix());
    }
    run.pose = plan.goal.pose;
    run.look();
    plan = follower.plan(run.map, run.pose);
  }
  EXPECT_GE(plans, 2U);
}

TEST(NextBestViewPlanner, IsBlockedIfNoViewIsAdmittedOrTheRobotDoesNotMove) {
  std::size_t blocked = 0;
  for (const Settings& more : {Settings{{"min_unknown_cells", "5"}}, Settings{}}) {
    Settings settings{{"object", "-0.3,-0.3,0.7,0.3,0.3,1.15"}, {"radii_m", "0.7"}, {"aimed_candidates", "0"}};
    settings.insert(more.begin(), more.end());
    const auto expect_blocked = [&](const Plan& plan, std::string_view remedy) {
      EXPECT_EQ(plan.outcome, Outcome::Blocked) << plan.reason;
      EXPECT_NE(plan.reason.find(remedy), std::string::npos) << plan.reason;
      ++blocked;
    };
    RobotAtTable run(2);
    const OccupancyMap empty({.resolution_m = 0.05, .region = run.world.frame.box_of(run.world.solid.box())});
    expect_blocked(make_planner("next-best-view", run.setup(), settings)->plan(empty, run.pose), "assume_free");

    Pose outside = run.pose;
    outside.translation().z() = 5.0;
    EXPECT_EQ(make_planner("next-best-view", run.setup(), settings)->plan(run.map, run.pose).outcome, Outcome::Move);
    expect_blocked(make_planner("next-best-view", run.setup(), settings)->plan(run.map, outside), "does not admit");

    for (const bool reports : {false, true}) {
      const auto planner = make_planner("next-best-view", run.setup(), settings);
      Plan plan = planner->plan(run.map, run.pose);
      std::size_t plans = 0;
      for (; plan.outcome == Outcome::Move && plans < 600; ++plans) {
        if (reports) {
          planner->report(run.map, run.pose, GoalResult::Failed);
        }
        run.map.confirm();
        plan = planner->plan(run.map, run.pose);
      }
      EXPECT_LT(plans, 600U);
      if (!reports || plan.outcome == Outcome::Blocked) {
        expect_blocked(plan, "free it");
      } else {  // all views lie on one side of the robot
        EXPECT_NE(plan.reason.find("does not get to"), std::string::npos) << plan.reason;
      }
    }
  }
  EXPECT_GE(blocked, 6U);
}

TEST(NextBestViewPlanner, ReconstructsByAnyGain) {
  std::size_t gains = 0;
  for (const std::string_view name : ray_gain_names()) {
    RobotAtTable run(3);
    EXPECT_LT(reconstruct(run, {{"gain", std::string(name)}, {"subdivisions", "0"}}), 20U) << name;
    EXPECT_GT(run.coverage(), 0.9) << name;
    ++gains;
  }
  EXPECT_EQ(gains, 5U);
}

TEST(NextBestViewPlanner, GoesForWhatItsSensorWouldMeasure) {
  RobotAtTable run(2);
  const NextBestViewOptions any{
      .candidates = {.object = kObject, .radii_m = {0.8}, .subdivisions = 1, .aimed_candidates = 0},
      .min_unknown_cells = 5};
  NextBestViewOptions steep = any;
  steep.sensing = {.max_incidence_rad = 0.9, .min_depth_m = 0.5, .max_depth_m = 1.0};
  const Plan plan = NextBestViewPlanner(run.setup(), steep).plan(run.map, run.pose);
  ASSERT_EQ(plan.outcome, Outcome::Move);
  for (const VoxelIndex& cell : plan.sought) {
    const Eigen::Vector3d back = plan.goal.pose.translation() - run.map.frame().centre_of(cell);
    const Eigen::Vector3d normal = surface_normal(run.map, cell).cast<double>();
    EXPECT_GE(back.norm(), 0.5);
    EXPECT_LE(back.norm(), 1.0);
    EXPECT_TRUE(normal.isZero() || normal.dot(back.normalized()) >= std::cos(0.9) - 1e-6);
  }
  EXPECT_LT(plan.goal.utility, NextBestViewPlanner(run.setup(), any).plan(run.map, run.pose).goal.utility);
  steep.sensing = {.max_depth_m = 0.3};
  EXPECT_EQ(NextBestViewPlanner(run.setup(), steep).plan(run.map, run.pose).outcome, Outcome::Explored);
}

TEST(NextBestViewPlanner, NamesWhatIsWrong) {
  const RobotAtTable run(1);
  const auto complaint = [&](const Settings& settings) -> std::string {
    try {
      (void)make_planner("next-best-view", run.setup(), settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const auto around = [](Settings settings) {
    settings.merge(Settings{{"object", "-0.3,-0.3,0.7,0.3,0.3,1.15"}});
    return settings;
  };
  EXPECT_EQ(complaint(around({{"min_unknown_cells", "20"}})), "");
  EXPECT_EQ(complaint(around({{"method", "default"}, {"view_price", "2"}})), "");
  EXPECT_NE(complaint({{"object", "1,2,3"}}).find("must be six numbers"), std::string::npos);
  EXPECT_NE(complaint({{"object", "0,0,0,1,1,1,1"}}).find("must be six numbers"), std::string::npos);
  EXPECT_EQ(complaint({{"object", "0,0,0,1,-1,1"}}),
            "ObjectViewOptions::object must have min < max on every axis and be finite");
  EXPECT_NE(complaint(around({{"radii_m", "1,0"}})).find("must be numbers > 0, with commas between them"),
            std::string::npos);
  EXPECT_NE(complaint(around({{"radii_m", "1,,2"}})).find("must be numbers > 0, with commas between them"),
            std::string::npos);
  EXPECT_EQ(complaint(around({{"subdivisions", "7"}})),
            "ObjectPlannerOptions::subdivisions is 7, must be in [-1, 6]");
  EXPECT_EQ(complaint(around({{"min_unknown_cells", "0"}})),
            "NextBestViewOptions::min_unknown_cells is 0, must be >= 1");
  EXPECT_NE(complaint(around({{"gain", "entropy"}})).find("unknown-cells, occlusion-aware"), std::string::npos);
  EXPECT_THROW(
      NextBestViewPlanner(run.setup(), {.candidates = {.object = kObject}, .sensing = {.max_incidence_rad = 2.1}}),
      std::invalid_argument);
  EXPECT_EQ(complaint({{"hypotheses", "0"}}), "NextBestViewExplorerOptions::hypotheses is 0, must be in [1, 1e+06]");
  // A setting that would do nothing is refused.
  EXPECT_EQ(complaint({{"radii_m", "1"}}),
            "planner 'next-best-view without an object' has no setting 'radii_m'; it has: patience, hypotheses");
  EXPECT_NE(
      complaint(around({{"hypotheses", "5"}})).find("'next-best-view of an object' has no setting 'hypotheses'"),
      std::string::npos);
  EXPECT_NE(complaint(around({{"gain", "unknown-cells"}, {"view_price", "5"}}))
                .find("'next-best-view by the paper's utility' has no setting 'view_price'"),
            std::string::npos);
}

}  // namespace
}  // namespace vantage
