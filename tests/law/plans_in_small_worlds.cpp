// SPDX-License-Identifier: MIT
// Prints every bit of every plan of short runs, so that builds of this program can be compared: with the compiled
// library and with vantage::headers, for several instruction sets.
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>

#include "contract/cell_world.hpp"

namespace {

using vantage::testing::CellWorld;
using vantage::testing::Furniture;

void print(const vantage::Pose& pose) {
  for (const double number : pose.matrix().reshaped()) {
    std::printf(" %a", number);
  }
  std::printf("\n");
}

void print(const vantage::Plan& plan) {
  std::printf("%s %zu %a\n", std::string(to_string(plan.outcome)).c_str(), plan.path.size(), plan.goal.utility);
  for (const vantage::Pose& pose : plan.path) {
    print(pose);
  }
}

int run(std::string_view name, const CellWorld& world) {
  constexpr int kViews = 8;
  vantage::RangeSensor sensor = vantage::RangeSensor::pinhole(96, 72, 1.2, 0.95, 0.1, 6.0);
  sensor.reports_no_return = true;
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.15});
  vantage::OccupancyMap map({.resolution_m = world.frame.size_m, .region = world.frame.box_of(world.solid.box())});
  const auto planner = vantage::make_planner(name, {.sensor = sensor, .platform = robot});
  vantage::Pose pose = vantage::pose_looking(world.frame.centre_of(world.start), 0.0);
  assume_free(map, *robot, pose, start_clearance_m(map, *robot, sensor));
  int plans = 0;
  while (plans < kViews) {
    map.insert(vantage::testing::scan_cells_of(world, sensor, pose));
    const vantage::Plan plan = planner->plan(map, pose);
    ++plans;
    print(plan);
    if (plan.outcome != vantage::Outcome::Move) {
      break;
    }
    pose = plan.path.back();
  }
  return plans;
}

}  // namespace

int main() {
  int plans = 0;
  for (const std::string_view name : vantage::planner_names()) {
    for (const Furniture furniture : {Furniture::Rooms, Furniture::Pillars, Furniture::Boxes}) {
      std::printf("%s\n", std::string(name).c_str());
      plans += run(name, vantage::testing::make_cell_world(furniture, 1));
    }
  }
  std::printf("%d plans\n", plans);
  return plans > 50 ? 0 : 1;
}
