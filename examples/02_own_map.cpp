// SPDX-License-Identifier: MIT
// How does a host use vantage that maps by itself? Its grid answers what a cell is; MapFollower keeps the map that
// planners read in step with it.
#include <algorithm>
#include <iostream>
#include <memory>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>

// A dense grid: what a ray passes is free, where one has ended is occupied.
struct HostGrid {
  vantage::VoxelFrame frame;
  vantage::VoxelGrid<vantage::Occupancy> cells;  // Unknown at first

  vantage::Occupancy at(const vantage::VoxelIndex& cell) const { return cells[cell]; }  // all that vantage asks of it

  void mark(const vantage::VoxelIndex& cell, vantage::Occupancy state) {
    if (cells.contains(cell)) {
      cells[cell] = std::max(cells[cell], state);
    }
  }
  void integrate(const vantage::Scan& scan) {
    for (const Eigen::Vector3f& point : scan.points) {
      const Eigen::Vector3d end = scan.world_from_sensor * point.cast<double>();
      if (frame.addressable(end)) {  // not NaN
        for (const vantage::VoxelIndex& cell : vantage::VoxelRay(frame, scan.world_from_sensor.translation(), end)) {
          mark(cell, cell == frame.cell_of(end) ? vantage::Occupancy::Occupied : vantage::Occupancy::Free);
        }
      }
    }
  }
};

int main() {
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor camera(vantage::TriangleScene(world.mesh), sensor);

  vantage::MapFollower follower({.resolution_m = 0.2, .region = world.region});
  const vantage::VoxelFrame frame = follower.map().frame();
  HostGrid grid{frame, vantage::VoxelGrid<vantage::Occupancy>(frame.cells_centred_in(world.region))};
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});
  vantage::Pose pose = vantage::pose_looking({0.9, 0.9, 1.0}, 0.0);  // world_from_sensor
  vantage::for_each_cell(frame.cells_touched_by(robot->body_box(pose)),
                         [&](const vantage::VoxelIndex& cell) { grid.mark(cell, vantage::Occupancy::Free); });

  for (int views = 1;; ++views) {
    grid.integrate(camera.scan(pose));
    follower.update(grid, grid.cells.box());  // a host that knows what has changed passes a smaller box
    const vantage::Plan plan = planner->plan(follower.map(), pose);
    if (plan.outcome != vantage::Outcome::Move) {
      std::cout << to_string(plan.outcome) << " after " << views << " views, "
                << vantage::frontier_cells(grid, grid.cells.box()).size() << " frontier cells left\n";
      return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
    }
    pose = plan.path.back();
  }
}
