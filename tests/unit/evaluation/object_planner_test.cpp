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
  explicit LookedAtObject(std::string_view name, bool reports_no_return = true)
      : sensor(RangeSensor::pinhole(96, 96, 0.8, 0.8, 0.0, 5.0)), object(generated_object(name, 3)) {
    sensor.reports_no_return = reports_no_return;
    scene = object_scene(object, sensor, {.resolution_m = 0.03});
    options.map.resolution_m = 0.03;
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
      const LookedAtObject at(name, reports_no_return);
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
      EXPECT_LT(most, at.options.object_surface.size() / 16) << name << ", " << reports_no_return;
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

TEST(ObjectPlanner, NamesWhatIsWrong) {
  const LookedAtObject at("mug");
  const auto complaint = [&](const std::function<void(ObjectPlannerOptions&)>& spoil) -> std::string {
    ObjectPlannerOptions options{.object = at.scene.box};
    spoil(options);
    try {
      const ObjectPlanner planner({.sensor = at.sensor, .platform = at.platform}, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](ObjectPlannerOptions&) {}), "");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) { o.object = {}; }),
            "ObjectPlannerOptions::object must have min < max on every axis and be finite");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) { o.radii_m = {}; }),
            "ObjectPlannerOptions::radii_m is empty, must have at least one radius");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) {
              o.radii_m = {1.0, 0.0};
            }),
            "ObjectPlannerOptions::radii_m is 0, must be > 0");
  EXPECT_EQ(complaint([](ObjectPlannerOptions& o) { o.min_new_share = 1.0; }),
            "ObjectPlannerOptions::min_new_share is 1, must be in [0, 1)");
}

}  // namespace
}  // namespace vantage
