// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <random>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>

namespace vantage {
namespace {

const Box kObject{{-0.3, -0.3, 0.44}, {0.3, 0.3, 0.9}};

// Two boxes, one on the other, on the table, with points on their surfaces.
struct Stack {
  Stack() {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const Box& box : {Box{{-0.2, -0.15, 0.4273}, {0.2, 0.15, 0.6}}, Box{{-0.05, -0.1, 0.6}, {0.1, 0.12, 0.8}}}) {
      world.mesh.add_box(box);
      for (int i = 0; i < 1500; ++i) {
        Eigen::Vector3d point =
            box.min + box.extent().cwiseProduct(Eigen::Vector3d(share(engine), share(engine), share(engine)));
        const int side = i % 5;  // not the bottom
        const Eigen::Index axis = side / 2;
        point[axis] = axis == 2 || side % 2 == 1 ? box.max[axis] : box.min[axis];
        const bool under_the_upper = axis == 2 && point.z() == 0.6 && point.x() > -0.05 && point.x() < 0.1;
        if (!under_the_upper) {
          surface.push_back(point);
        }
      }
    }
  }
  World world = World::by_name("table");
  std::vector<Eigen::Vector3d> surface;
};

RunRecord reconstructed(const Stack& stack, const SensorNoise& noise, std::uint64_t seed) {
  const RangeSensor sensor = RangeSensor::preset("vpl");
  const auto platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.05});
  ExplorationRunOptions options;
  options.map.resolution_m = 0.04;
  options.max_views = 30;
  options.scan_spacing_m = 0.0;
  options.seed = seed;
  options.noise = noise;
  options.measure_coverage = false;
  options.unknown_box = kObject;
  options.surface_samples = stack.surface;
  options.surface_gap_m = 0.04;
  ExplorationRun run(stack.world, sensor, platform, options);
  NextBestViewPlanner planner({.sensor = sensor, .platform = platform},
                              {.candidates = {.object = kObject, .subdivisions = 1}, .min_unknown_cells = 10});
  return run.run(planner, pose_looking_along({-1.5, 0.0, 0.7}, {1.0, 0.0, 0.0}));
}

TEST(NoisyReconstruction, LosesLittleCoverageAndEnds) {
  const Stack stack;
  std::size_t runs = 0;
  for (const double kinects : {0.0, 1.0, 2.0}) {
    for (const double poses : {0.0, 1.0}) {
      const SensorNoise noise{
          .axial = kinects, .position_m = 0.01 * poses, .angle_rad = 0.5 * poses * std::numbers::pi / 180.0};
      const RunRecord record = reconstructed(stack, noise, 3 + runs);
      EXPECT_EQ(record.outcome, RunOutcome::Explored) << record.reason;
      EXPECT_LT(record.views.size(), 15U);
      EXPECT_GT(record.surface_coverage.value_or(0.0), kinects + poses > 0.0 ? 0.9 : 0.97)
          << kinects << " Kinects, poses off by " << poses;
      ++runs;
    }
  }
  EXPECT_EQ(runs, 6U);
}

}  // namespace
}  // namespace vantage
