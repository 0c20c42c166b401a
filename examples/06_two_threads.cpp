// SPDX-License-Identifier: MIT
// How does a host map and plan at the same time? One map under one lock: a thread inserts every scan, another plans
// as soon as there is a scan from where the robot has arrived. A plan takes milliseconds, so the scans can wait for
// it.
#include <condition_variable>
#include <cstddef>
#include <iostream>
#include <memory>
#include <mutex>
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
  std::size_t scans = 0;
  bool ended = false;
};

void map_until_the_end(Shared& shared, vantage::SimulatedSensor& camera) {
  for (;;) {
    std::unique_lock guard(shared.lock);
    if (shared.ended) {
      return;
    }
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
  shared.map.assume_free(robot->body_box(shared.pose));
  std::thread mapping(map_until_the_end, std::ref(shared), std::ref(camera));

  std::unique_lock guard(shared.lock);
  vantage::Plan plan;
  do {
    shared.scanned.wait(guard, [&] { return shared.scans > 0 && shared.last_scan.isApprox(shared.pose); });
    plan = planner->plan(shared.map, shared.pose);
    for (const vantage::Pose& next : plan.path) {
      shared.pose = next;  // a controller moves here, without the lock
      guard.unlock();
      std::this_thread::yield();
      guard.lock();
    }
  } while (plan.outcome == vantage::Outcome::Move);
  shared.ended = true;
  guard.unlock();
  mapping.join();
  std::cout << to_string(plan.outcome) << " after " << shared.scans << " scans: " << plan.reason << '\n';
  return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
}
