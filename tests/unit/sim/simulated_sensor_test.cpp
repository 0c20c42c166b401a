// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string_view>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/triangle_scene.hpp>

namespace vantage {
namespace {

TriangleMesh box_room(double half_m) {
  TriangleMesh mesh;
  mesh.add_box({Eigen::Vector3d::Constant(-half_m), Eigen::Vector3d::Constant(half_m)});
  return mesh;
}

TEST(TriangleScene, HitsWhatBruteForceHits) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<float> metre(-2.0F, 2.0F);
  std::size_t hits = 0;
  for (int world = 0; world < 20; ++world) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 60; ++i) {
      mesh.vertices.emplace_back(metre(engine), metre(engine), metre(engine));
      if (i % 3 == 2) {
        mesh.triangles.push_back({i - 2, i - 1, i});
      }
    }
    const TriangleScene scene(mesh);
    for (int ray = 0; ray < 200; ++ray) {
      const Eigen::Vector3d origin(metre(engine), metre(engine), metre(engine));
      const Eigen::Vector3d direction = Eigen::Vector3d(metre(engine), metre(engine), metre(engine)).normalized();
      double nearest = 3.0;
      for (const auto& t : mesh.triangles) {
        Eigen::Matrix3d system;
        const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>();
        system << mesh.vertices[t[1]].cast<double>() - a, mesh.vertices[t[2]].cast<double>() - a, -direction;
        const Eigen::Vector3d uvt = system.partialPivLu().solve(origin - a);
        if (uvt.x() >= 0 && uvt.y() >= 0 && uvt.x() + uvt.y() <= 1 && uvt.z() >= 0) {
          nearest = std::min(nearest, uvt.z());
        }
      }
      const auto found = scene.hit_distance(origin, direction, 3.0);
      EXPECT_NEAR(found.value_or(3.0), nearest, 1e-4);
      hits += found ? 1U : 0U;
    }
  }
  EXPECT_GT(hits, 1000U);
}

TEST(TriangleScene, MeasuresDistancesAndSweptSpheres) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> metre(-0.95, 0.95);
  const TriangleScene scene(box_room(1.0));
  std::size_t touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from(metre(engine), metre(engine), metre(engine));
    const Eigen::Vector3d to(metre(engine), metre(engine), metre(engine));
    EXPECT_NEAR(scene.distance(from, 5.0), 1.0 - from.cwiseAbs().maxCoeff(), 1e-5);
    const double widest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    const double radius = 0.3;
    if (std::abs(widest + radius - 1.0) < 1e-3) {
      continue;
    }
    EXPECT_EQ(scene.touches(from, to, radius), widest + radius > 1.0);
    touching += widest + radius > 1.0 ? 1U : 0U;
  }
  EXPECT_GT(touching, 500U);
  EXPECT_TRUE(scene.touches({0, 0, 0}, {3, 0, 0}, 0.0)) << "through the wall";
  TriangleMesh broken;
  broken.triangles.push_back({0, 1, 2});
  EXPECT_THROW(TriangleScene{broken}, std::invalid_argument);
}

TEST(SimulatedSensor, MeasuresTheRoomItStandsIn) {
  const TriangleScene scene(box_room(1.0));
  std::size_t points = 0;
  for (const char* name : {"kinect", "panoramic", "lidar"}) {
    SimulatedSensor simulated(scene, RangeSensor::preset(name));
    const Pose pose = pose_looking({0.1, -0.2, 0.15}, 0.7, 0.3);
    const Scan scan = simulated.scan(pose);
    EXPECT_TRUE(scan.organised());
    EXPECT_TRUE(scan.no_return.empty());
    for (std::size_t i = 0; i < scan.points.size(); i += 11) {
      const Eigen::Vector3d world = pose * scan.points[i].cast<double>();
      ASSERT_NEAR(world.cwiseAbs().maxCoeff(), 1.0, 1e-5) << name;
      ++points;
    }
  }
  EXPECT_GT(points, 50'000U);
}

TEST(SimulatedSensor, OnlyASensorThatKnowsReportsNoReturn) {
  const TriangleScene scene(box_room(30.0));
  SimulatedSensor lidar(scene, RangeSensor::preset("lidar"));
  const Scan clear = lidar.scan(Pose::Identity());
  EXPECT_EQ(clear.no_return.size(), lidar.sensor().width * lidar.sensor().height);
  EXPECT_TRUE(clear.points.empty());
  SimulatedSensor kinect(scene, RangeSensor::preset("kinect"));
  const Scan silent = kinect.scan(Pose::Identity());
  EXPECT_TRUE(silent.no_return.empty());
  EXPECT_TRUE(std::isnan(silent.points[0].x()));
}

// With distant walls, noise and dropped returns, the map counts each ray once.
TEST(SimulatedSensor, EveryRayIsCountedOnce) {
  std::mt19937_64 engine(12);
  std::uniform_real_distribution<double> metre(-1.5, 1.5);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  ScanReport sum;
  std::size_t scans = 0;
  std::size_t images = 0;
  for (const std::string_view name : RangeSensor::preset_names()) {
    RangeSensor sensor = RangeSensor::preset(name).rays_for(0.5);
    sensor.max_range_m = 4.0;
    for (const bool knows : {false, true}) {
      sensor.reports_no_return = knows;
      SimulatedSensor simulated(TriangleScene(box_room(3.5)), sensor, {.axial = 1.0, .dropped_share = 0.1}, 5);
      for (int view = 0; view < 5; ++view, ++scans) {
        const Scan scan =
            simulated.scan(pose_looking({metre(engine), metre(engine), metre(engine)}, angle(engine), 0.4));
        EXPECT_EQ(scan.points.size() + scan.no_return.size(), sensor.width * sensor.height) << name;
        EXPECT_EQ(scan.organised(), scan.no_return.empty()) << name;
        EXPECT_TRUE(knows || scan.organised()) << name;
        images += scan.organised() ? 1U : 0U;
        OccupancyMap map({.resolution_m = 0.2});
        const ScanReport report = map.insert(scan);
        EXPECT_EQ(report.no_return, scan.no_return.size()) << name;
        EXPECT_EQ(report.hits + report.beyond_range + report.no_return + report.not_finite + report.zero_length +
                      report.not_addressable,
                  sensor.width * sensor.height)
            << name;
        sum.hits += report.hits;
        sum.no_return += report.no_return;
        sum.not_finite += report.not_finite;
      }
    }
  }
  EXPECT_EQ(scans, 10 * RangeSensor::preset_names().size());
  EXPECT_LT(images, scans);
  EXPECT_GT(sum.hits, 10'000U);
  EXPECT_GT(sum.no_return, 1000U);
  EXPECT_GT(sum.not_finite, 1000U);
}

TEST(SimulatedSensor, ASurfaceTooNearGivesNothingAtAll) {
  const TriangleScene scene(box_room(0.3));
  RangeSensor sensor = RangeSensor::preset("kinect");
  sensor.reports_no_return = true;
  const Scan scan = SimulatedSensor(scene, sensor).scan(pose_looking({0, 0, 0}, 0.0));
  EXPECT_TRUE(std::isnan(scan.points[sensor.width * sensor.height / 2].x()));
  EXPECT_TRUE(scan.no_return.empty());
}

TEST(SimulatedSensor, NoiseIsSeededAndAsLargeAsItSays) {
  const TriangleScene scene(box_room(3.0));
  const RangeSensor sensor = RangeSensor::preset("kinect");
  const SensorNoise noise{.axial = 1.0, .dropped_share = 0.2};
  const Pose pose = pose_looking({0, 0, 0}, 0.0);
  SimulatedSensor a(scene, sensor, noise, 3);
  SimulatedSensor b(scene, sensor, noise, 3);
  double squares = 0.0;
  std::size_t returns = 0;
  Scan before;
  for (int i = 0; i < 3; ++i) {
    const Scan scan = a.scan(pose);
    const Scan same = b.scan(pose);
    std::size_t changed = 0;
    for (std::size_t p = 0; p < scan.points.size(); ++p) {
      const bool nan = std::isnan(scan.points[p].z());
      ASSERT_EQ(nan, std::isnan(same.points[p].z()));
      if (!nan) {
        ASSERT_EQ(scan.points[p], same.points[p]);
        squares += std::pow(static_cast<double>(scan.points[p].z()) - 3.0, 2);
        ++returns;
        changed += i > 0 && before.points[p] != scan.points[p] ? 1U : 0U;
      }
    }
    EXPECT_TRUE(i == 0 || changed > 100'000U) << "each scan has its own noise";
    before = scan;
  }
  const double share = static_cast<double>(returns) / (3.0 * 640 * 480);
  EXPECT_NEAR(share, 0.8, 0.01);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(returns)), 0.0012 + 0.0019 * 2.6 * 2.6, 1e-4);
  EXPECT_THROW(SimulatedSensor(scene, sensor, {.axial = -1.0}), std::invalid_argument);
  EXPECT_THROW(SimulatedSensor(scene, sensor, {.dropped_share = 1.5}), std::invalid_argument);
}

// The plane of the wall ahead in the sensor frame: distance, and rotation about x and y.
std::array<double, 3> wall_ahead(const Scan& scan) {
  const auto at = [&](std::size_t column, std::size_t row) {
    return Eigen::Vector3d(scan.points[row * scan.width + column].cast<double>());
  };
  const Eigen::Vector3d across = at(scan.width - 1, 0) - at(0, 0);
  const Eigen::Vector3d down = at(0, scan.height - 1) - at(0, 0);
  const Eigen::Vector3d normal = across.cross(down).normalized();
  return {normal.dot(at(0, 0)), std::atan2(normal.y(), normal.z()), std::atan2(normal.x(), normal.z())};
}

TEST(SimulatedSensor, IsAsFarFromWhereItIsSaidToBeAsTheNoiseHasIt) {
  const TriangleScene scene(box_room(3.0));
  const RangeSensor sensor = RangeSensor::pinhole(8, 6, 0.5, 0.4, 0.0, 8.0);
  const Pose pose = pose_looking({0, 0, 0}, 0.0);
  SimulatedSensor simulated(scene, sensor, {.position_m = 0.01, .angle_rad = 0.02}, 3);
  SimulatedSensor again(scene, sensor, {.position_m = 0.01, .angle_rad = 0.02}, 3);
  std::array<double, 3> squares{};
  constexpr int kScans = 2000;
  for (int i = 0; i < kScans; ++i) {
    const Scan scan = simulated.scan(pose);
    EXPECT_EQ(scan.world_from_sensor.matrix(), pose.matrix());
    EXPECT_EQ(again.scan(pose).points[7], scan.points[7]);
    const auto [distance_m, about_x, about_y] = wall_ahead(scan);
    squares[0] += std::pow(distance_m - 3.0, 2) / kScans;
    squares[1] += about_x * about_x / kScans;
    squares[2] += about_y * about_y / kScans;
  }
  EXPECT_NEAR(std::sqrt(squares[0]), 0.01, 6e-4);
  EXPECT_NEAR(std::sqrt(squares[1]), 0.02, 12e-4);
  EXPECT_NEAR(std::sqrt(squares[2]), 0.02, 12e-4);
  EXPECT_THROW(SimulatedSensor(scene, sensor, {.position_m = -1.0}), std::invalid_argument);
  EXPECT_THROW(SimulatedSensor(scene, sensor, {.angle_rad = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
