// SPDX-License-Identifier: MIT
// How does a robot go on after a restart? It saves its map and what its planner remembers, and loads both.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>

// Explores until the planner ends or the views are spent. Returns the last plan; `pose` is where the robot stands.
vantage::Plan explore(vantage::ExplorationPlanner& planner, vantage::OccupancyMap& map,
                      vantage::SimulatedSensor& camera, int views, vantage::Pose& pose) {
  vantage::Plan plan;
  for (int view = 0; view < views; ++view) {
    map.insert(camera.scan(pose));
    plan = planner.plan(map, pose);
    if (plan.outcome != vantage::Outcome::Move) {
      break;
    }
    pose = plan.path.back();
  }
  return plan;
}

int main() {
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor camera(vantage::TriangleScene(world.mesh), sensor);
  const vantage::OccupancyMapOptions of_map{.resolution_m = 0.2, .region = world.region};
  const vantage::PlannerSetup setup{.sensor = sensor, .platform = robot};
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::filesystem::path map_file = folder / "vantage_resume.ot";
  const std::filesystem::path memory_file = folder / "vantage_resume.memory";
  vantage::Pose pose = vantage::pose_looking({0.9, 0.9, 1.0}, 0.0);  // world_from_sensor

  {  // the first day
    vantage::OccupancyMap map(of_map);
    assume_free(map, *robot, pose);
    const auto planner = vantage::make_planner("nearest-frontier", setup);
    explore(*planner, map, camera, 20, pose);
    vantage::save_octomap(map, map_file);
    std::ofstream(memory_file) << planner->memory();
  }
  // the second day
  vantage::OccupancyMap map = vantage::load_octomap(map_file, {.map = of_map}).map;
  const std::size_t known = map.counts().free;
  const auto planner = vantage::make_planner("nearest-frontier", setup);
  std::ifstream memory(memory_file);
  planner->recall(map, std::string(std::istreambuf_iterator<char>(memory), {}));
  const vantage::Plan plan = explore(*planner, map, camera, 500, pose);
  std::filesystem::remove(map_file);
  std::filesystem::remove(memory_file);
  std::cout << to_string(plan.outcome) << " after a restart with " << known << " of " << map.counts().free
            << " free cells: " << plan.reason << '\n';
  return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
}
