// SPDX-License-Identifier: MIT
// A complete simulated run: mesh, sensor, planner and coverage.
#include <iostream>
#include <memory>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>

int main() {
  vantage::World world{"box with a pillar", {}, {{0, 0, 0}, {4, 3, 2}}};
  world.mesh.add_box({{0.05, 0.05, 0.05}, {3.95, 2.95, 1.95}});
  world.mesh.add_box({{1.85, 1.25, 0.05}, {2.15, 1.75, 1.95}});

  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.15});
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});
  vantage::ExplorationRun run(world, sensor, robot, {.map = {.resolution_m = 0.1}, .max_views = 50});
  const vantage::RunRecord record = run.run(*planner, vantage::pose_looking({0.55, 1.55, 1.05}, 0.0));
  std::cout << to_string(record.outcome) << " after " << record.views.size() << " views, " << record.path_length_m()
            << " m: " << 100.0 * record.coverage.value_or(0.0) << " % of " << record.observable_cells << " cells, "
            << record.collisions << " collisions\n";
  return record.outcome == vantage::RunOutcome::Explored && record.coverage.value_or(0.0) > 0.95 &&
                 record.collisions == 0
             ? 0
             : 1;
}
