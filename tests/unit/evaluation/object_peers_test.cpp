// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vantage/evaluation/object_peers.hpp>
#include <vantage/evaluation/test_objects.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vector>

namespace vantage {
namespace {

RangeSensor small_camera() {
  RangeSensor sensor = RangeSensor::pinhole(64, 64, 0.8, 0.8, 0.0, 4.0);
  sensor.reports_no_return = true;
  return sensor;
}

struct ObjectInView {
  explicit ObjectInView(const TriangleMesh& object, double resolution_m = 0.04)
      : scene(object_scene(object, small_camera(), {.resolution_m = resolution_m})),
        run(scene.world, small_camera(), platform, options(object, resolution_m)),
        surface(TriangleScene(scene.world.mesh), sample_surface(object, 2'000), small_camera()) {}

  [[nodiscard]] ExplorationRunOptions options(const TriangleMesh& object, double resolution_m) const {
    ExplorationRunOptions options;
    options.map.resolution_m = resolution_m;
    options.max_views = 6;
    options.scan_spacing_m = 0.0;
    options.measure_coverage = false;
    options.unknown_box = scene.box;
    options.object_surface = sample_surface(object, 2'000);
    return options;
  }
  [[nodiscard]] ObjectPeerSetup setup(std::uint64_t seed = 1) const {
    return {
        .platform = platform, .scene = &scene, .truth = &run.truth(), .surface = &surface, .views = 6, .seed = seed};
  }

  std::shared_ptr<const FreeFlyer> platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.05});
  ObjectScene scene;
  ExplorationRun run;
  SeenSurface surface;
};

TEST(ObjectPeers, TakeViewsThatAreAdmittedAndTheOracleSeesMost) {
  std::map<std::string, double> after_three;
  for (const std::string_view object : {"crate", "chair"}) {
    ObjectInView in_view(generated_object(object, 5));
    for (const std::string_view name : object_peer_names()) {
      const auto peer = make_object_peer(name, in_view.setup());
      EXPECT_EQ(peer->name(), name);
      const Pose start =
          peer->first_view().value_or(draw_first_view(in_view.scene, in_view.run.truth(), *in_view.platform, 2));
      const RunRecord record = in_view.run.run(*peer, start);
      if (name == "oracle-greedy") {
        EXPECT_LE(record.views.size(), 6U) << "it ends when it has seen all";
        EXPECT_NE(record.outcome, RunOutcome::Blocked) << record.reason;
      } else {
        EXPECT_EQ(record.views.size(), 6U) << name;
      }
      EXPECT_EQ(record.collisions, 0U) << name;
      ASSERT_TRUE(record.seen_observable);
      EXPECT_LE(*record.seen_observable, 1.0);
      EXPECT_GE(*record.seen_observable, *record.seen_coverage);
      after_three[std::string(name)] +=
          *record.views[std::min<std::size_t>(3, record.views.size()) - 1].seen_coverage;
    }
  }
  for (const auto& [name, seen] : after_three) {
    EXPECT_LE(seen, after_three["oracle-greedy"]) << name;
  }
}

TEST(ObjectPeers, PlanTheSameTwiceAndDrawFromTheSeed) {
  ObjectInView in_view(generated_object("blob"));
  OccupancyMap map({.resolution_m = 0.04, .region = in_view.scene.world.region});
  map.assume_free(in_view.scene.world.region);
  const Pose start = draw_first_view(in_view.scene, in_view.run.truth(), *in_view.platform, 1);
  for (const std::string_view name : object_peer_names()) {
    const auto peer = make_object_peer(name, in_view.setup());
    const Plan plan = peer->plan(map, start);
    ASSERT_EQ(plan.outcome, Outcome::Move) << name;
    EXPECT_TRUE(peer->plan(map, start).goal.pose.isApprox(plan.goal.pose)) << name;
    EXPECT_TRUE(make_object_peer(name, in_view.setup())->plan(map, start).goal.pose.isApprox(plan.goal.pose)) << name;
  }
  const auto other = make_object_peer("random-views", in_view.setup(2));
  EXPECT_FALSE(
      other->plan(map, start)
          .goal.pose.isApprox(make_object_peer("random-views", in_view.setup(1))->plan(map, start).goal.pose));
  EXPECT_THROW((void)make_object_peer("psychic", in_view.setup()), std::invalid_argument);
  EXPECT_THROW((void)make_object_peer("evenly-spaced", {}), std::invalid_argument);
}

// A flyer that is admitted only at the heights that a spiral of twelve views takes on the shell.
class AtTwelveHeights final : public Platform {
 public:
  AtTwelveHeights(const Eigen::Vector3d& middle, double radius_m) : middle_(middle), radius_m_(radius_m) {}
  [[nodiscard]] bool admits(const OccupancyMap&, const Pose& pose) const override {
    const double row = 6.0 * (1.0 - (pose.translation() - middle_).z() / radius_m_) - 0.5;
    return std::abs(row - std::round(row)) < 0.02;
  }
  [[nodiscard]] bool admits_cell(const OccupancyMap&, const VoxelIndex&) const override { return true; }
  [[nodiscard]] bool admits_motion(const OccupancyMap&, const Pose&, const Pose&) const override { return true; }
  [[nodiscard]] Pose facing(const Eigen::Vector3d& position_m, const Eigen::Vector3d& direction) const override {
    return pose_looking_along(position_m, direction);
  }
  [[nodiscard]] double distance_m(const Pose& from, const Pose& to) const override {
    return (to.translation() - from.translation()).norm();
  }
  [[nodiscard]] std::optional<std::vector<Pose>> path(const OccupancyMap&, const Pose& from,
                                                      const Pose& to) const override {
    return std::vector<Pose>{from, to};
  }
  [[nodiscard]] Box body_box(const Pose& pose) const override { return {pose.translation(), pose.translation()}; }
  [[nodiscard]] bool can_tilt() const override { return true; }

 private:
  Eigen::Vector3d middle_;
  double radius_m_;
};

TEST(ObjectPeers, EvenlySpacedViewsReachFromTheTopToTheBottomOfWhatIsAdmitted) {
  ObjectInView in_view(generated_object("crate", 5));
  ObjectPeerSetup setup = in_view.setup();
  const Eigen::Vector3d middle = in_view.scene.box.centre();
  const double radius_m = in_view.scene.radii_m.front();
  setup.platform = std::make_shared<const AtTwelveHeights>(middle, radius_m);
  const auto peer = make_object_peer("evenly-spaced", setup);
  OccupancyMap map({.resolution_m = 0.04});
  Pose at = peer->first_view().value();
  std::vector<double> heights{(at.translation() - middle).z() / radius_m};
  Plan plan = peer->plan(map, at);
  for (; plan.outcome == Outcome::Move; plan = peer->plan(map, at)) {
    at = plan.goal.pose;
    heights.push_back((at.translation() - middle).z() / radius_m);
    map.confirm();
  }
  EXPECT_EQ(plan.outcome, Outcome::Blocked) << "a fixed order does not know whether something is left";
  ASSERT_EQ(heights.size(), 6U);
  for (std::size_t i = 0; i < heights.size(); ++i) {  // every other one of the twelve
    EXPECT_NEAR(heights[i], 1.0 - (4.0 * double(i) + 3.0) / 12.0, 1e-9);
  }
}

TEST(TestObjects, StandOnTheGroundAndVaryWithTheSeed) {
  for (const std::string_view name : generated_object_names()) {
    const TriangleMesh mesh = generated_object(name);
    EXPECT_NEAR(mesh.bounds().min.z(), 0.0, 1e-6) << name;
    EXPECT_GT(mesh.bounds().extent().minCoeff(), 0.02) << name;
    EXPECT_FALSE(mesh.bounds().extent().isApprox(generated_object(name, 2).bounds().extent())) << name;
  }
  EXPECT_THROW((void)generated_object("teapot"), std::invalid_argument);
}

TEST(ObjectScene, LooksFromWhereTheObjectFits) {
  for (const double size_m : {0.1, 0.3, 0.5}) {
    TriangleMesh mesh;
    mesh.add_box({{0.0, 0.0, 0.0}, {size_m, size_m, size_m}});
    const RangeSensor sensor = small_camera();
    const ObjectScene scene = object_scene(mesh, sensor, {.resolution_m = 0.05});
    const FreeFlyer platform({.radius_m = 0.05});
    const Truth truth(scene.world, 0.05, scene.world.region);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Pose first = draw_first_view(scene, truth, platform, seed);
      EXPECT_TRUE(platform.admits(truth.map(), first));
      std::size_t in_view = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d at((corner & 1) * size_m, (corner >> 1 & 1) * size_m, (corner >> 2 & 1) * size_m);
        in_view += sensor.in_view(first.inverse() * at) ? 1U : 0U;
        EXPECT_LT((first.translation() - at).norm(), sensor.max_range_m);
      }
      EXPECT_EQ(in_view, 8U) << size_m;
    }
  }
}

// A view from below the top of the table shows the table.
TEST(ObjectScene, TheFirstViewOfAnObjectOnTheTableShowsIt) {
  int views = 0;
  for (const char* name : {"mug", "banana", "lamp", "blob"}) {
    TriangleMesh object;
    object.append(generated_object(name), Pose(Eigen::Translation3d(0.0, 0.0, kTableTopM)));
    const RangeSensor sensor = small_camera();
    const ObjectScene scene = object_scene(object, sensor, {.table = true, .resolution_m = 0.04});
    const FreeFlyer platform({.radius_m = 0.05});
    const Truth truth(scene.world, 0.04, scene.world.region);
    const SeenSurface surface(TriangleScene(scene.world.mesh), sample_surface(object, 500), sensor);
    std::size_t most = 0;
    std::size_t fewest = 500;
    for (std::uint64_t seed = 1; seed <= 25; ++seed, ++views) {
      const Pose first = draw_first_view(scene, truth, platform, seed);
      const std::size_t seen = surface.visible_from(first).size();
      most = std::max(most, seen);
      fewest = std::min(fewest, seen);
    }
    EXPECT_GT(2 * fewest, most) << name;
  }
  EXPECT_EQ(views, 100);
}

}  // namespace
}  // namespace vantage
