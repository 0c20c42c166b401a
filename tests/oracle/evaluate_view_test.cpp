// SPDX-License-Identifier: MIT
// Visibility of a view: the fast algorithm against uniform ray tracing, hierarchical ray tracing against its
// definition.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <support/hollow_map.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/hierarchical_ray_tracer.hpp>
#include <vector>

#include "support/sanitized.hpp"

namespace vantage {
namespace {

// A box next to free space, and a pose that looks at it.
struct Case {
  Case(std::mt19937& engine, const VoxelFrame& frame) {
    std::uniform_int_distribution<std::int32_t> coordinate(-30, 20);
    std::uniform_int_distribution<std::int32_t> edge(1, 40);
    std::uniform_real_distribution<double> metre(-1.5, 1.5);
    const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
    box = {lo, lo + VoxelIndex{edge(engine), edge(engine), edge(engine)}};
    const Eigen::Vector3d eye(metre(engine), metre(engine), metre(engine));
    pose = pose_looking_along(eye, frame.box_of(box).centre() - eye);
  }

  VoxelBox box;
  Pose pose;
};

TEST(EvaluateView, CountsWhatUniformRayTracingCounts) {
  std::mt19937 engine(41);
  constexpr int kWorlds = test::kSanitized ? 15 : 60;
  std::size_t cases = 0;
  ViewEvaluation sum;
  for (int world = 0; world < kWorlds; ++world) {
    const OccupancyMap map = test::hollow_map(engine, 0.1);
    const RayCaster caster(map);
    const UniformRayTracer uniform(map);
    for (int i = 0; i < 20; ++i) {
      const Case c(engine, map.frame());
      const double min_range_m = i % 4 == 0 ? 1.0 : 0.0;
      const RangeSensor sensor =
          i % 5 == 0 ? RangeSensor::spherical(90, 40, 6.28, 3.0, min_range_m, 6.0)
                     : RangeSensor::pinhole(1 + engine() % 120, 1 + engine() % 90, 1.2, 0.9, min_range_m, 8.0);
      const ViewRays rays(sensor);
      CellSet expected_cells;
      CellSet cells;
      const ViewEvaluation expected = uniform.evaluate(c.pose, rays, c.box, &expected_cells);
      ASSERT_EQ(evaluate_view(caster, c.pose, rays, c.box, &cells), expected);
      ASSERT_TRUE(cells == expected_cells);
      ASSERT_EQ(cells.size(), expected.unknown + expected.occupied);
      sum.unknown += expected.unknown;
      sum.occupied += expected.occupied;
      ++cases;
    }
  }
  EXPECT_EQ(cases, 20U * kWorlds);
  EXPECT_GT(sum.unknown, 300U * kWorlds);
  EXPECT_GT(sum.occupied, 50U * kWorlds);
}

// Boxes at the side of the image: their rays advance fastest along another axis than the central ones, many rays
// miss, and some boxes surround the sensor on two sides.
TEST(EvaluateView, CountsWhatLiesAsideToo) {
  std::mt19937 engine(43);
  constexpr int kWorlds = test::kSanitized ? 6 : 20;
  std::uniform_int_distribution<std::int32_t> coordinate(-200, 150);
  std::uniform_int_distribution<std::int32_t> edge(1, 60);
  std::uniform_int_distribution<std::int32_t> long_edge(1, 400);
  std::uniform_real_distribution<double> metre(-1.5, 1.5);
  std::uniform_real_distribution<double> aside_rad(0.0, 1.2);
  std::uniform_real_distribution<double> turn_rad(0.0, 6.28);
  std::size_t cases = 0;
  std::size_t seen = 0;
  for (int world = 0; world < kWorlds; ++world) {
    const OccupancyMap map = test::hollow_map(engine, 0.1);
    const RayCaster caster(map);
    const UniformRayTracer uniform(map);
    for (int i = 0; i < 40; ++i, ++cases) {
      const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
      auto& any = i % 4 == 0 ? long_edge : edge;
      const VoxelBox box{lo, lo + VoxelIndex{any(engine), any(engine), any(engine)}};
      const Eigen::Vector3d eye(metre(engine), metre(engine), metre(engine));
      const Eigen::Vector3d to_box = (map.frame().box_of(box).centre() - eye).normalized();
      const Eigen::Vector3d across = Eigen::AngleAxisd(turn_rad(engine), to_box) * to_box.unitOrthogonal();
      const Pose pose = pose_looking_along(eye, Eigen::AngleAxisd(aside_rad(engine), across) * to_box);
      const ViewRays rays(i % 3 == 0
                              ? RangeSensor::spherical(60, 30, 6.28, 3.0, 0.0, 50.0)
                              : RangeSensor::pinhole(8 + engine() % 60, 8 + engine() % 60, 2.0, 2.0, 0.0, 50.0));
      CellSet expected_cells;
      CellSet cells;
      const ViewEvaluation expected = uniform.evaluate(pose, rays, box, &expected_cells);
      ASSERT_EQ(evaluate_view(caster, pose, rays, box, &cells), expected) << "world " << world << ", view " << i;
      ASSERT_TRUE(cells == expected_cells);
      seen += expected.unknown + expected.occupied;
    }
  }
  EXPECT_EQ(cases, 40U * kWorlds);
  EXPECT_GT(seen, 100U * kWorlds);
}

TEST(EvaluateView, ThreadsChangeNothing) {
  std::mt19937 engine(42);
  const OccupancyMap map = test::hollow_map(engine, 0.1);
  const RayCaster caster(map);
  const ViewRays rays(RangeSensor::preset("vpl"));
  std::vector<Pose> views;
  const Case c(engine, map.frame());
  for (int i = 0; i < 40; ++i) {
    views.push_back(Case(engine, map.frame()).pose);
  }
  const std::vector<ViewEvaluation> one = evaluate_views(caster, views, rays, c.box, 1);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(one[i], evaluate_view(caster, views[i], rays, c.box));
  }
  EXPECT_EQ(evaluate_views(caster, views, rays, c.box, 3), one);
  EXPECT_THROW((void)evaluate_views(caster, views, rays, c.box, 0), std::invalid_argument);
  views[20].linear() *= 3.0;
  EXPECT_THROW((void)evaluate_views(caster, views, rays, c.box, 2), std::invalid_argument);
}

// A second, simple implementation of Algorithm 2 on the map itself.
struct SlowHierarchy {
  const OccupancyMap& map;
  const RayTree& tree;
  const HierarchicalRayTracerOptions& options;
  const Case& of;
  double range_m;
  HierarchicalCounts counts = {};

  struct Level {
    const OccupancyMap& map;
    int level;
    CoarseningPolicy policy;
    [[nodiscard]] Occupancy at(const VoxelIndex& cell) const { return map.at(cell, level, policy); }
  };

  [[nodiscard]] bool in_box(const VoxelIndex& cell, int level) const {
    const std::int32_t edge = 1 << level;
    const VoxelIndex lo{cell.x * edge, cell.y * edge, cell.z * edge};
    const VoxelIndex hi = lo + VoxelIndex{edge, edge, edge};
    return lo.x < of.box.hi.x && of.box.lo.x < hi.x && lo.y < of.box.hi.y && of.box.lo.y < hi.y &&
           lo.z < of.box.hi.z && of.box.lo.z < hi.z;
  }
  void trace(int k, std::uint32_t ray) {
    ++counts.casts;
    const int level = tree.levels() - 1 - k;
    const Eigen::Vector3d from = of.pose.translation();
    const Eigen::Vector3d along = of.pose.linear() * tree.rays(k).directions[ray].cast<double>();
    const RayEnd end = first_not_free(Level{map, level, options.policy},
                                      VoxelFrame{map.resolution_m() * (1 << level)}, from, from + range_m * along);
    const bool inside = in_box(end.cell, level);
    if (end.occupancy == Occupancy::Unknown && inside) {
      counts.unknown += tree.leaves(k, ray);
    }
    if (end.occupancy == Occupancy::Occupied && tree.children(k, ray).empty()) {
      counts.occupied += inside ? 1U : 0U;
    } else if (end.occupancy == Occupancy::Occupied && (inside || options.refine_outside)) {
      for (const std::uint32_t child : tree.children(k, ray)) {
        trace(k + 1, child);
      }
    }
  }
};

TEST(HierarchicalRayTracer, DoesWhatAlgorithm2Says) {
  std::mt19937 engine(43);
  const RangeSensor sensor = RangeSensor::pinhole(64, 48, 0.9, 0.7, 0.0, 4.0);
  HierarchicalCounts sum;
  std::size_t cases = 0;
  for (int world = 0; world < 24; ++world) {
    const OccupancyMap map = test::hollow_map(engine, 0.1);
    const HierarchicalRayTracerOptions options{
        1 + world % 4, world % 2 == 0 ? CoarseningPolicy::Max : CoarseningPolicy::Mean, world % 3 == 0};
    const HierarchicalRayTracer tracer(map, sensor, options);
    for (int i = 0; i < 3; ++i) {
      const Case c(engine, map.frame());
      SlowHierarchy slow{map, tracer.tree(), options, c, sensor.max_range_m};
      for (std::uint32_t ray = 0; ray < tracer.tree().rays(0).directions.size(); ++ray) {
        slow.trace(0, ray);
      }
      const HierarchicalCounts counts = tracer.evaluate(c.pose, c.box);
      EXPECT_EQ(counts, slow.counts) << "world " << world;
      sum.occupied += counts.occupied;
      sum.unknown += counts.unknown;
      ++cases;
    }
  }
  EXPECT_EQ(cases, 72U);
  EXPECT_GT(sum.occupied, 300U);
  EXPECT_GT(sum.unknown, 3'000U);
}

TEST(HierarchicalRayTracer, FollowsTheMap) {
  std::mt19937 engine(44);
  OccupancyMap map = test::hollow_map(engine, 0.1);
  const RangeSensor sensor = RangeSensor::pinhole(64, 48, 0.9, 0.7, 0.0, 4.0);
  HierarchicalRayTracer following(map, sensor);
  for (int step = 0; step < 5; ++step) {
    const Case c(engine, map.frame());
    map.set_log_odds(c.box, step % 2 == 0 ? -2.0 : 1.0);
    following.update();
    EXPECT_EQ(following.evaluate(c.pose, c.box), HierarchicalRayTracer(map, sensor).evaluate(c.pose, c.box));
  }
}

}  // namespace
}  // namespace vantage
