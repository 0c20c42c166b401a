// SPDX-License-Identifier: MIT
// How does a host describe its own sensor? By the rays that it has, and by the pose of the frame in which its driver
// gives the points. Here: a lidar of 16 rows, whose driver has x forward, y left and z up.
#include <cstddef>
#include <iostream>
#include <memory>
#include <numbers>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>
#include <vector>

// A point as a driver lays it out in its message.
struct LidarPoint {
  float x, y, z, intensity;
};

// Takes the place of the driver: points in the axes of the lidar.
std::vector<LidarPoint> message_of(const vantage::Scan& scan, const Eigen::Matrix3f& lidar_from_sensor) {
  std::vector<LidarPoint> message;
  for (const Eigen::Vector3f& point : scan.points) {
    const Eigen::Vector3f in_lidar = lidar_from_sensor * point;
    message.push_back({in_lidar.x(), in_lidar.y(), in_lidar.z(), 1.0F});
  }
  return message;
}

int main() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  vantage::RangeSensor lidar = vantage::RangeSensor::spherical(900, 16, 360 * kDegree, 30 * kDegree, 0.3, 20.0);
  lidar.reports_no_return = false;                              // this driver leaves out rays that met nothing
  vantage::Pose lidar_from_sensor = vantage::Pose::Identity();  // a RangeSensor has +z forward, +x right, +y down
  lidar_from_sensor.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;

  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor simulated(vantage::TriangleScene(world.mesh), lidar);
  vantage::OccupancyMap map({.resolution_m = 0.2, .region = world.region});
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = lidar, .platform = robot});
  vantage::Pose pose = vantage::pose_looking({0.9, 0.9, 1.0}, 0.0);  // world_from_sensor
  vantage::assume_free(map, *robot, pose, vantage::start_clearance_m(map, *robot, lidar));

  for (std::size_t views = 1;; ++views) {
    const auto message = message_of(simulated.scan(pose), lidar_from_sensor.linear().cast<float>());
    map.insert(vantage::ScanView{.world_from_sensor = pose * lidar_from_sensor.inverse(),
                                 .points = vantage::PointsView(message.data(), message.size(), sizeof(LidarPoint)),
                                 .max_range_m = lidar.max_range_m});
    const vantage::Plan plan = planner->plan(map, pose);
    if (plan.outcome != vantage::Outcome::Move) {
      std::cout << to_string(plan.outcome) << " after " << views << " views: " << plan.reason << '\n';
      return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
    }
    pose = plan.path.back();
  }
}
