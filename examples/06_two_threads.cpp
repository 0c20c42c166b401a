// SPDX-License-Identifier: MIT
// How does a host map and plan at the same time? One map under one lock: a thread inserts every scan, another plans
// as soon as there is a scan from where the robot has arrived. A plan takes milliseconds, so scans can wait for it.
#include <condition_variable>
#include <iostream>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>

// What both threads share, under `lock`.
struct Shared {
  std::mutex lock = {};
  std::condition_variable scanned = {};
  vantage::OccupancyMap map;
  vantage::Pose pose;            // where the robot is, from its localisation
  vantage::Pose last_scan = {};  // where the last scan of the map was taken
  int scans = 0;
};

void map_scans(const std::stop_token& stop, Shared& shared, vantage::SimulatedSensor& camera) {
  std::unique_lock guard(shared.lock);
  while (!stop.stop_requested()) {
    const vantage::Pose from = shared.pose;
    guard.unlock();
    const vantage::Scan scan = camera.scan(from);  // a driver blocks here, without the lock
    guard.lock();
    shared.map.insert(scan);
    shared.last_scan = from;
    ++shared.scans;
    shared.scanned.notify_one();
  }
}

int main() {
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor camera(vantage::TriangleScene(world.mesh), sensor);
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});

  Shared shared{.map = vantage::OccupancyMap({.resolution_m = 0.2, .region = world.region}),
                .pose = vantage::pose_looking({0.9, 0.9, 1.0}, 0.0)};
  assume_free(shared.map, *robot, shared.pose);
  const std::jthread mapping(map_scans, std::ref(shared), std::ref(camera));  // stopped and joined at the end
  std::unique_lock guard(shared.lock);
  for (;;) {
    shared.scanned.wait(guard, [&] { return shared.scans > 0 && shared.last_scan.isApprox(shared.pose); });
    const vantage::Plan plan = planner->plan(shared.map, shared.pose);
    if (plan.outcome != vantage::Outcome::Move) {
      std::cout << to_string(plan.outcome) << " after " << shared.scans << " scans: " << plan.reason << '\n';
      return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
    }
    // The simulated robot is at the goal at once. A real controller moves there without holding the lock.
    shared.pose = plan.path.back();
  }
}
