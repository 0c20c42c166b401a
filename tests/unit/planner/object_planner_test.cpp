// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vantage/evaluation/test_objects.hpp>
#include <vantage/planner/object_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/view/candidate_views.hpp>

namespace vantage {
namespace {

// A camera in free space in front of an object.
struct LookedAtObject {
  explicit LookedAtObject(std::string_view name, bool reports_no_return = true, double cell_m = 0.03)
      : sensor(RangeSensor::pinhole(96, 96, 0.8, 0.8, 0.0, 5.0)), object(generated_object(name, 3)) {
    sensor.reports_no_return = reports_no_return;
    scene = object_scene(object, sensor, {.resolution_m = cell_m});
    options.map.resolution_m = cell_m;
    options.max_views = 40;
    options.scan_spacing_m = 0.0;
    options.measure_coverage = false;
    options.unknown_box = scene.box;
    options.object_surface = sample_surface(object, 2'000);
  }
  [[nodiscard]] std::unique_ptr<ExplorationPlanner> planner(int threads = 1) const {
    return make_planner("next-best-view", {.sensor = sensor, .platform = platform, .threads = threads},
                        planner_settings(scene));
  }

  RangeSensor sensor;
  TriangleMesh object;
  ObjectScene scene;
  ExplorationRunOptions options;
  std::shared_ptr<const FreeFlyer> platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.05});
};

// After Explored, the true surface shows whether a view of the sphere would show much more.
TEST(ObjectPlanner, EndsWhenNoViewWouldShowMore) {
  std::size_t runs = 0;
  for (const std::string_view name : {"chair", "crate", "vase", "banana", "shelf"}) {
    for (const bool reports_no_return : {true, false}) {
      // Two opposite views show all faces of a cell. A rod as thin as a cell would be complete after them.
      const LookedAtObject at(name, reports_no_return, name == "banana" ? 0.01 : 0.03);
      ExplorationRun run(at.scene.world, at.sensor, at.platform, at.options);
      const auto planner = at.planner();
      EXPECT_EQ(planner->name(), "next-best-view");
      SeenSurface surface(TriangleScene(at.scene.world.mesh), at.options.object_surface, at.sensor);
      const RunRecord record = run.run(*planner, draw_first_view(at.scene, run.truth(), *at.platform, 1),
                                       [&](const ViewRecord& view, const OccupancyMap&) { surface.add(view.pose); });
      EXPECT_EQ(record.outcome, RunOutcome::Explored) << name << ", " << reports_no_return << ": " << record.reason;
      EXPECT_GT(record.views.size(), 3U) << name;
      EXPECT_EQ(record.collisions, 0U) << name;
      std::size_t most = 0;
      for (const Pose& view : views_around(at.scene.box.centre(), at.scene.radii_m)) {
        const std::vector<std::uint32_t> visible = surface.visible_from(view);
        most =
            std::max(most, static_cast<std::size_t>(std::count_if(
                               visible.begin(), visible.end(), [&](auto sample) { return !surface.seen(sample); })));
      }
      EXPECT_LT(most, at.options.object_surface.size() / 32) << name << ", " << reports_no_return;
      EXPECT_GT(record.seen_observable.value_or(0.0), 0.9) << name << ", " << reports_no_return;
      ++runs;
    }
  }
  EXPECT_EQ(runs, 10U);
}

TEST(ObjectPlanner, PlansTheSameTwiceAndOnAnyNumberOfThreads) {
  const LookedAtObject at("chair");
  ExplorationRun run(at.scene.world, at.sensor, at.platform, at.options);
  const auto planner = at.planner();
  std::size_t plans = 0;
  const Pose start = draw_first_view(at.scene, run.truth(), *at.platform, 1);
  const auto on_threads = at.planner(3);
  run.run(*planner, start, [&](const ViewRecord& view, const OccupancyMap& map) {
    const Plan again = planner->plan(map, view.pose);
    const Plan other = on_threads->plan(map, view.pose);
    EXPECT_EQ(again.outcome, other.outcome);
    EXPECT_EQ(again.goal.utility, other.goal.utility);
    EXPECT_TRUE(again.goal.pose.matrix() == other.goal.pose.matrix());
    EXPECT_EQ(again.goal.utility, view.utility) << "the plan of the run itself";
    ++plans;
  });
  EXPECT_GT(plans, 3U);
}

// The goal is, of all candidates, the one that shows most for its cost; a higher price leads further for more.
TEST(ObjectPlanner, WeighsNewSurfaceAgainstTheWay) {
  const LookedAtObject at("blob");
  ExplorationRunOptions once = at.options;
  once.max_views = 1;
  ExplorationRun run(at.scene.world, at.sensor, at.platform, once);
  const auto first = at.planner();
  const Pose start = draw_first_view(at.scene, run.truth(), *at.platform, 1);
  const RunRecord record = run.run(*first, start);
  ASSERT_EQ(record.views.size(), 1U);
  double last_gain = 0.0;
  double last_way_m = 0.0;
  for (const double price : {0.01, 1.0, 1e4}) {
    const double radius_m = at.scene.radii_m.front();
    ObjectPlanner planner({.sensor = at.sensor, .platform = at.platform},
                          {.candidates = {.object = at.scene.box, .radii_m = {radius_m}}, .view_price = price});
    const Plan plan = planner.plan(run.map(), start);
    ASSERT_EQ(plan.outcome, Outcome::Move);
    double most = 0.0;
    for (const View& candidate : plan.candidates) {
      most = std::max(most, candidate.utility);
    }
    const double way_m = (plan.goal.pose.translation() - start.translation()).norm();
    EXPECT_GE(plan.goal.utility, last_gain) << price;
    EXPECT_GE(way_m, last_way_m) << price;
    EXPECT_TRUE(price < 1e4 || plan.goal.utility == most) << "the way hardly counts";
    EXPECT_TRUE(price > 0.01 || plan.goal.utility < 0.9 * most) << "the way counts most";
    last_gain = plan.goal.utility;
    last_way_m = way_m;
  }
}

TEST(ObjectPlanner, NamesWhatIsWrong) {
  const LookedAtObject at("mug");
  const auto complaint = [&](const std::function<void(ObjectPlannerOptions&)>& spoil) -> std::string {
    ObjectPlannerOptions options{.candidates = {.object = at.scene.box}};
    spoil(options);
    try {
      const ObjectPlanner planner({.sensor = at.sensor, .platform = at.platform}, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](ObjectPlannerOptions&) {}), "");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) { o.candidates.object = {}; }),
            "ObjectViewOptions::object must have min < max on every axis and be finite");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) {
              o.candidates.radii_m = {1.0, 0.0};
            }),
            "ObjectViewOptions::radii_m is 0, must be > 0");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) { o.min_new_share = 1.0; }),
            "ObjectPlannerOptions::min_new_share is 1, must be in [0, 1)");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) { o.view_price = 0.0; }),
            "ObjectPlannerOptions::view_price is 0, must be in (0, 1e+06]");
}

}  // namespace
}  // namespace vantage
