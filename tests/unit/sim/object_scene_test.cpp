// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/view/candidate_views.hpp>

namespace vantage {
namespace {

// A cuboid on the table.
TriangleMesh cuboid(double edge_m) {
  TriangleMesh mesh;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * edge_m);
  const Eigen::Vector3d middle(0.0, 0.0, kTableTopM + half.z() + 1e-3);
  mesh.add_box({middle - half, middle + half});
  return mesh;
}

// Also for a body that is larger than the object.
TEST(ObjectScene, TheRegionHoldsTheShellsTheBodyAndTheStart) {
  std::mt19937 engine(3);
  const auto draw = [&](double lo, double hi) { return lo + (hi - lo) * static_cast<double>(engine()) * 0x1p-32; };
  const Box room = World::by_name("table").region;
  std::size_t on_shells = 0;
  std::size_t smaller = 0;
  for (int i = 0; i < 60; ++i) {
    ObjectSceneOptions options{.table = i % 2 == 0, .resolution_m = 0.02, .body_radius_m = draw(0.02, 0.3)};
    if (i % 3 == 0) {
      options.radii_m = {draw(0.4, 0.8), draw(0.4, 1.6)};
    }
    if (i % 4 == 0) {
      options.start = Eigen::Vector3d(draw(-1.0, 1.0), draw(-1.0, 1.0), draw(0.7, 1.5));
    }
    const ObjectScene scene = object_scene(cuboid(draw(0.05, 0.4)), RangeSensor::preset("vpl"), options);
    const Box& region = scene.world.region;
    const auto fits = [&](const Eigen::Vector3d& place) {
      const Eigen::Vector3d body = Eigen::Vector3d::Constant(options.body_radius_m);
      return region.contains(place - body) && region.contains(place + body);
    };
    const auto fits_into_room = [&](const Eigen::Vector3d& place) {
      const Eigen::Vector3d body = Eigen::Vector3d::Constant(options.body_radius_m);
      return !options.table || (room.contains(place - body) && room.contains(place + body));
    };
    for (const Pose& view : views_around(scene.box.centre(), scene.radii_m)) {
      EXPECT_EQ(fits(view.translation()), fits_into_room(view.translation())) << i;
      ++on_shells;
    }
    if (options.table && options.start) {
      EXPECT_EQ(fits(*options.start), fits_into_room(*options.start)) << i;
    }
    smaller += options.table && region.extent().prod() < 0.5 * room.extent().prod() ? 1U : 0U;
  }
  EXPECT_GT(on_shells, 10'000U);
  EXPECT_GT(smaller, 5U);
}

TEST(ObjectScene, TheBodyDoesNotTouchTheBoxFromItsOwnShell) {
  std::size_t large_bodies = 0;
  for (const double body_m : {0.05, 0.3, 0.6, 0.9}) {
    for (const double edge_m : {0.05, 0.2, 0.6}) {
      const ObjectScene scene =
          object_scene(cuboid(edge_m), RangeSensor::preset("vpl"), {.resolution_m = 0.04, .body_radius_m = body_m});
      ASSERT_EQ(scene.radii_m.size(), 1U);
      for (const Pose& view : views_around(scene.box.centre(), scene.radii_m)) {
        EXPECT_GT(scene.box.distance_to(view.translation()), body_m) << "body " << body_m << ", object " << edge_m;
      }
      large_bodies += body_m > edge_m ? 1U : 0U;
    }
  }
  EXPECT_GT(large_bodies, 4U);
}

// Takes no view.
class NoPlanner final : public ExplorationPlanner {
 public:
  [[nodiscard]] std::string_view name() const override { return "none"; }
  [[nodiscard]] Plan plan(const OccupancyMap& /*map*/, const Pose& /*pose*/) override { return {}; }
};

// Known free space around an object takes hardly any memory, although it is known cell by cell.
TEST(ObjectScene, MemoryDoesNotFollowTheRoom) {
  const auto bytes_and_cells = [](double radius_m) {
    const RangeSensor sensor = RangeSensor::preset("vpl");
    const ObjectScene scene = object_scene(cuboid(0.1), sensor, {.radii_m = {radius_m}, .resolution_m = 0.02});
    const auto platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.05});
    ExplorationRunOptions options;
    options.map.resolution_m = 0.02;
    options.measure_coverage = false;
    options.unknown_box = scene.box;
    ExplorationRun run(scene.world, sensor, platform, options);
    NoPlanner planner;
    (void)run.run(planner, draw_first_view(scene, run.truth(), *platform, 1));
    const OccupancyMap::Counts counts = run.map().counts();
    EXPECT_GT(counts.free, 100 * counts.occupied);
    return std::pair(static_cast<double>(run.map().resident_bytes() + run.truth().map().resident_bytes()),
                     static_cast<double>(counts.free));
  };
  const auto [few_bytes, few_cells] = bytes_and_cells(0.5);
  const auto [many_bytes, many_cells] = bytes_and_cells(2.5);
  EXPECT_GT(many_cells, 50.0 * few_cells);
  EXPECT_LT((many_bytes - few_bytes) / (many_cells - few_cells), 1.0) << "bytes of a cell in two maps; 2.7 unshared";
}

}  // namespace
}  // namespace vantage
