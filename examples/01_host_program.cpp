// SPDX-License-Identifier: MIT
// How does a host use vantage? Map, plan, move, repeat. The simulated sensor takes the place of a driver.
#include <cstddef>
#include <iostream>
#include <memory>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>

int main() {
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor camera(vantage::TriangleScene(world.mesh), sensor);

  vantage::OccupancyMap map({.resolution_m = 0.2, .region = world.region});
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});
  vantage::Pose pose = vantage::pose_looking({0.9, 0.9, 1.0}, 0.0);  // world_from_sensor
  assume_free(map, *robot, pose);

  for (std::size_t views = 1;; ++views) {
    map.insert(camera.scan(pose));
    const vantage::Plan plan = planner->plan(map, pose);
    if (plan.outcome != vantage::Outcome::Move) {
      std::cout << to_string(plan.outcome) << " after " << views << " views: " << plan.reason << '\n';
      return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
    }
    pose = plan.path.back();  // a robot follows the path and scans on the way
  }
}
