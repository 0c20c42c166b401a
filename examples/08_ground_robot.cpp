// SPDX-License-Identifier: MIT
// How does a robot explore that drives? A HeightBand makes a plane of the heights of its body and of the floor; the
// planner explores that plane.
#include <cstddef>
#include <iostream>
#include <memory>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>

int main() {
  const auto robot = std::make_shared<vantage::GroundRobot>(vantage::GroundRobotOptions{.radius_m = 0.25});
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("lidar");
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor lidar(vantage::TriangleScene(world.mesh), sensor);

  vantage::Box region = world.region;
  region.min.z() = -0.2;  // two cells below the deepest step that the robot may drive down
  vantage::OccupancyMap map({.resolution_m = 0.1, .region = region});
  vantage::HeightBand band(map.options(), {.min_height_m = 0.3, .max_height_m = 1.2, .sensor_height_m = 0.8});
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});
  vantage::Pose pose = vantage::pose_looking({0.9, 0.9, 0.8}, 0.0);  // world_from_sensor
  vantage::Box body = robot->body_box(pose);                         // of the layer of the sensor
  body.min.z() = band.options().min_height_m;
  body.max.z() = band.options().max_height_m;
  map.assume_free(body);
  band.assume_floor(pose.translation(), start_floor_m(band, *robot, sensor));

  for (std::size_t views = 1;; ++views) {
    map.insert(lidar.scan(pose));
    band.follow(map);
    const vantage::Plan plan = planner->plan(band.plane(), pose);
    if (plan.outcome != vantage::Outcome::Move) {
      std::cout << to_string(plan.outcome) << " after " << views << " views: " << plan.reason << '\n';
      return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
    }
    pose = plan.path.back();
  }
}
