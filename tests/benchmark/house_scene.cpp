// SPDX-License-Identifier: MIT
#include <benchmark/house_scene.hpp>
#include <memory>
#include <random>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {
namespace {

Pose somewhere(const Truth& truth, const Platform& platform, const Box& region) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (;;) {
    const Eigen::Array3d place(share(engine), share(engine), share(engine));
    const Pose pose =
        pose_looking(region.min + (place * region.extent().array()).matrix(), 6.28 * share(engine), 0.0);
    if (platform.admits(truth.map(), pose)) {
      return pose;
    }
  }
}

}  // namespace

std::pair<LaplaceDomain, VoxelIndex> house_scene(const std::filesystem::path& data, std::size_t views) {
  World world = World::from_file(data / "environments/aws_small_house/small_house_visual.ply");
  world.region = {{-9.0, -5.0, 0.1}, {9.0, 5.0, 2.4}};
  const RangeSensor sensor = RangeSensor::preset("panoramic");
  const auto flyer = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15});
  ExplorationRun run(world, sensor, flyer,
                     {.map = {.resolution_m = 0.1}, .max_views = views, .measure_coverage = false});
  // Starts where a wider robot would also fit, not in a niche.
  const Pose start = somewhere(run.truth(), FreeFlyer({.radius_m = 0.6}), world.region);
  Pose latest = start;
  const auto planner = make_planner("harmonic", {.sensor = sensor, .platform = flyer});
  run.run(*planner, start, [&](const ViewRecord& view, const OccupancyMap&) { latest = view.pose; });
  return {known_free_domain(run.map()), run.map().frame().cell_of(latest.translation())};
}

}  // namespace vantage
