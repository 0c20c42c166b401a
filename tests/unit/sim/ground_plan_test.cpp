// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/ground_robot.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/ground_plan.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace vantage {
namespace {

// A plan from rows of text, the top row first.
GroundPlan drawn_plan(const std::vector<std::string>& rows, double pixel_m) {
  GroundPlan plan{.pixel_m = pixel_m};
  const auto height = static_cast<std::int32_t>(rows.size());
  plan.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {static_cast<std::int32_t>(rows[0].size()), height, 1}}, 0);
  for_each_cell(plan.solid.box(), [&](const VoxelIndex& pixel) {
    const char drawn = rows[static_cast<std::size_t>(height - 1 - pixel.y)][static_cast<std::size_t>(pixel.x)];
    plan.solid[pixel] = drawn == '#' ? 1 : 0;
  });
  return plan;
}

GroundPlan random_plan(std::mt19937_64& engine, double solid_share) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  GroundPlan plan{.pixel_m = 0.02 + 0.2 * unit(engine),
                  .x_m = 10.0 * unit(engine) - 5.0,
                  .y_m = 10.0 * unit(engine) - 5.0,
                  .yaw_rad = unit(engine) < 0.5 ? 0.0 : 7.0 * unit(engine)};
  const auto size = [&] { return 3 + static_cast<std::int32_t>(12.0 * unit(engine)); };
  plan.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {size(), size(), 1}}, 0);
  for (std::uint8_t& pixel : plan.solid.values()) {
    pixel = unit(engine) < solid_share ? 1 : 0;
  }
  plan.solid.values().front() = 0;
  return plan;
}

using Polygon = std::vector<Eigen::Vector2d>;

// The part of a convex polygon with `normal . p <= offset` (Sutherland & Hodgman 1974).
Polygon clipped(const Polygon& polygon, const Eigen::Vector2d& normal, double offset) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double over_a = normal.dot(a) - offset;
    const double over_b = normal.dot(b) - offset;
    if (over_a <= 0.0) {
      kept.push_back(a);
    }
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
      kept.emplace_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
  }
  return kept;
}

double area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

// The area of the box that is solid or outside the plan.
double solid_area(const GroundPlan& plan, const Box& box) {
  double solid = (box.max.x() - box.min.x()) * (box.max.y() - box.min.y());
  const Pose world_from_pixels = plan.world_from_plan();
  for_each_cell(plan.solid.box(), [&](const VoxelIndex& pixel) {
    if (plan.solid[pixel] != 0) {
      return;
    }
    Polygon free;
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      free.emplace_back(
          (world_from_pixels * (plan.pixel_m * Eigen::Vector3d(pixel.x + x, pixel.y + y, 0.0))).head<2>());
    }
    free = clipped(free, {1.0, 0.0}, box.max.x());
    free = clipped(free, {-1.0, 0.0}, -box.min.x());
    free = clipped(free, {0.0, 1.0}, box.max.y());
    free = clipped(free, {0.0, -1.0}, -box.min.y());
    solid -= area(free);
  });
  return solid;
}

TEST(GroundPlan, ABoxTouchesWhatIsSolidExactlyIfItSharesAreaWithIt) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t touching = 0;
  std::size_t clear = 0;
  for (int world = 0; world < 300; ++world) {
    const GroundPlan plan = random_plan(engine, 0.25 * unit(engine));
    const Box bounds = plan.bounds();
    for (int i = 0; i < 20; ++i) {
      Box box;
      for (int corner = 0; corner < 2; ++corner) {
        const double reach = corner == 0 ? 1.0 : 0.15;
        box.extend((corner == 0 ? bounds.min : box.min) +
                   reach * Eigen::Vector3d(unit(engine), unit(engine), 0.0).cwiseProduct(bounds.extent()));
      }
      const double solid_px = solid_area(plan, box) / (plan.pixel_m * plan.pixel_m);
      if (solid_px > 1e-4) {
        EXPECT_TRUE(plan.touches_solid(box)) << "of world " << world;
        ++touching;
      } else if (solid_px < 1e-9) {
        EXPECT_FALSE(plan.touches_solid(box)) << "of world " << world;
        ++clear;
      }
    }
  }
  EXPECT_GT(touching, 2000U);
  EXPECT_GT(clear, 500U);
}

TEST(GroundPlan, ARayEndsJustInsideTheFirstSolidPixel) {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RangeSensor sensor = in_plane(RangeSensor::spherical(72, 40, 6.28, 1.5, 0.0, 50.0));
  std::size_t rays = 0;
  std::size_t corners = 0;  // ends of rays that are not in a solid pixel
  for (int world = 0; world < 40; ++world) {
    const GroundPlan plan = random_plan(engine, 0.3);
    const TriangleScene scene(plan.walls());
    const VoxelFrame pixels{plan.pixel_m};
    const Pose pixels_from_world = plan.world_from_plan().inverse();
    const auto depth_px = [&](const Eigen::Vector3d& world_m) {  // depth inside solid pixels
      const Eigen::Vector3d at = pixels_from_world * world_m;
      double nearest_m = 10.0;
      for_each_cell(plan.solid.box(), [&](const VoxelIndex& pixel) {
        if (plan.solid[pixel] == 0) {
          Box box = pixels.box_of(pixel);
          box.min.z() = -1.0;
          nearest_m = std::min(nearest_m, box.distance_to(at));
        }
      });
      return nearest_m / plan.pixel_m;
    };
    for (const bool drawn : {false, true}) {
      VoxelIndex from{};
      if (drawn) {
        from = plan.solid.cell_at(engine() % plan.solid.size());
      }
      if (plan.solid[from] != 0) {
        continue;
      }
      const Eigen::Vector3d inside(0.2 + 0.6 * unit(engine), 0.2 + 0.6 * unit(engine), 0.0);
      const Pose pose = pose_looking(
          plan.world_from_plan() * (plan.pixel_m * (Eigen::Vector3d(from.x, from.y, 0.0) + inside)), unit(engine));
      const Scan scan = SimulatedSensor(scene, sensor).scan(pose);
      ASSERT_EQ(scan.points.size(), 72U);
      for (const Eigen::Vector3f& point : scan.points) {
        const Eigen::Vector3d end = pose * point.cast<double>();
        ASSERT_TRUE(end.allFinite()) << "a ray left the plan of world " << world;
        corners += depth_px(end) < 1e-3 ? 1U : 0U;
        for (double share = 0.0; share <= 1.0; share += 0.02) {
          EXPECT_LT(depth_px(pose.translation() + share * (end - pose.translation())), 0.0101 * std::sqrt(2.0));
        }
        ++rays;
      }
    }
  }
  EXPECT_GT(rays, 3000U);
  EXPECT_LT(corners, rays / 200) << "walls meet where solid pixels touch by a corner";
}

TEST(GroundPlan, ACellIsOccupiedWhereAnyPixelInItIs) {
  GroundPlan plan = drawn_plan({"....#", ".....", ".....", "#....", "....."}, 0.1);
  const World world = World::from_plan("drawn", plan);
  const Truth truth(world, 0.25, {{0, 0, 0}, {0.5, 0.5, 0.25}});
  EXPECT_EQ(truth.at({0, 0, 0}), CellTruth::Occupied);
  EXPECT_EQ(truth.at({1, 0, 0}), CellTruth::Free);
  EXPECT_EQ(truth.at({0, 1, 0}), CellTruth::Free);
  EXPECT_EQ(truth.at({1, 1, 0}), CellTruth::Occupied);
  EXPECT_EQ(truth.at({2, 1, 0}), CellTruth::Occupied) << "outside of the plan";
  plan.x_m = 0.249;
  const Truth moved(World::from_plan("drawn", plan), 0.25, {{0.25, 0, 0}, {0.75, 0.5, 0.25}});
  EXPECT_EQ(moved.at({1, 1, 0}), CellTruth::Free);
  EXPECT_EQ(moved.at({0, 0, 0}), CellTruth::Occupied);
  plan.x_m = -0.002;
  const Truth barely(World::from_plan("drawn", plan), 0.1, {{0, 0, 0}, {0.5, 0.5, 0.1}});
  EXPECT_EQ(barely.at({0, 1, 0}), CellTruth::Occupied);
  EXPECT_EQ(barely.at({3, 4, 0}), CellTruth::Grazed) << "2 mm of the cell";
}

TEST(GroundPlan, RobotsExploreItWithoutTouchingAWall) {
  const GroundPlan plan = drawn_plan(
      {
          "##############################",
          "#........#...................#",
          "#........#...................#",
          "#............#######.........#",
          "#............#.....#.........#",
          "#........#...#.....#.........#",
          "#........#.........#.........#",
          "##########...#.....#.........#",
          "#............#######.........#",
          "#............................#",
          "##############################",
      },
      0.2);
  const World world = World::from_plan("drawn", plan);
  std::size_t runs = 0;
  for (const double resolution_m : {0.1, 0.2}) {
    for (const char* name : {"lidar", "panoramic", "kinect"}) {
      const RangeSensor sensor = in_plane(RangeSensor::preset(name));
      const auto robot = std::make_shared<const GroundRobot>(GroundRobotOptions{.radius_m = 0.15});
      ExplorationRun run(world, sensor, robot, {.map = {.resolution_m = resolution_m}, .look_around = true});
      const auto planner = make_planner("nearest-frontier", {.sensor = sensor, .platform = robot}, {});
      const RunRecord record = run.run(
          *planner,
          pose_looking(VoxelFrame{resolution_m}.centre_of(VoxelFrame{resolution_m}.cell_of({4.9, 1.1, 0.0})), 0.0));
      EXPECT_GT(*record.coverage, sensor.reports_no_return ? 0.99 : 0.97) << name << " at " << resolution_m;
      EXPECT_EQ(record.collisions, 0U) << name << " at " << resolution_m;
      EXPECT_TRUE(record.outcome == RunOutcome::Explored || record.outcome == RunOutcome::Unreachable)
          << name << " at " << resolution_m << ": " << record.reason;
      ++runs;
    }
  }
  EXPECT_EQ(runs, 6U);
}

TEST(GroundPlan, NamesTheFieldAtFault) {
  const auto complaint_of = [](const GroundPlan& plan) -> std::string {
    try {
      plan.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const GroundPlan good = drawn_plan({"."}, 0.1);
  EXPECT_EQ(complaint_of(good), "");
  GroundPlan bad = good;
  bad.pixel_m = 0.0;
  EXPECT_EQ(complaint_of(bad), "GroundPlan::pixel_m is 0, must be > 0");
  bad = good;
  bad.yaw_rad = std::nan("");
  EXPECT_EQ(complaint_of(bad), "GroundPlan::yaw_rad is nan, must be finite");
  bad = good;
  bad.solid.values().front() = 1;
  EXPECT_EQ(complaint_of(bad), "GroundPlan::solid has no free pixel");
  bad = good;
  bad.solid = VoxelGrid<std::uint8_t>({{0, 0, 0}, {2, 2, 2}}, 0);
  EXPECT_EQ(complaint_of(bad), "GroundPlan::solid must be one layer of pixels from (0, 0, 0) on");
  const World world = World::from_plan("one", good);
  const auto robot = std::make_shared<const GroundRobot>(GroundRobotOptions{.radius_m = 0.0});
  EXPECT_THROW(ExplorationRun(world, RangeSensor::preset("lidar"), robot, {.band = HeightBandOptions{}}),
               std::invalid_argument);
  EXPECT_THROW(Truth(world, 0.05, world.region), std::invalid_argument) << "two layers";
}

}  // namespace
}  // namespace vantage
