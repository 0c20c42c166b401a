// SPDX-License-Identifier: MIT
// How does a host describe its own robot? A Platform says which poses and motions its body admits. Here: a flyer on a
// tether, which must stay within some metres of its anchor.
#include <cstddef>
#include <iostream>
#include <memory>
#include <vantage/robot/grid_path.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/world.hpp>
#include <vantage/vantage.hpp>

class TetheredFlyer final : public vantage::WrappedPlatform {
 public:
  TetheredFlyer(const vantage::FreeFlyerOptions& body, const Eigen::Vector3d& anchor_m, double tether_m)
      : WrappedPlatform(std::make_shared<vantage::FreeFlyer>(body)), anchor_m_(anchor_m), tether_m_(tether_m) {}

  bool admits(const vantage::OccupancyMap& map, const vantage::Pose& pose) const override {
    return holds(pose.translation()) && wrapped().admits(map, pose);
  }
  bool admits_cell(const vantage::OccupancyMap& map, const vantage::VoxelIndex& cell) const override {
    return holds(map.frame().centre_of(cell)) && wrapped().admits_cell(map, cell);
  }
  bool admits_motion(const vantage::OccupancyMap& map, const vantage::Pose& from,
                     const vantage::Pose& to) const override {
    return holds(to.translation()) && wrapped().admits_motion(map, from, to);  // a ball is convex
  }
  std::optional<std::vector<vantage::Pose>> path(const vantage::OccupancyMap& map, const vantage::Pose& from,
                                                 const vantage::Pose& to) const override {
    return vantage::grid_path(map, *this, from, to);
  }

 private:
  bool holds(const Eigen::Vector3d& position_m) const { return (position_m - anchor_m_).norm() <= tether_m_; }

  Eigen::Vector3d anchor_m_;
  double tether_m_;
};

int main() {
  vantage::Pose pose = vantage::pose_looking({0.9, 0.9, 1.0}, 0.0);  // world_from_sensor
  const auto robot =
      std::make_shared<TetheredFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2}, pose.translation(), 6.0);
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const vantage::World world = vantage::World::by_name("maze");
  vantage::SimulatedSensor camera(vantage::TriangleScene(world.mesh), sensor);
  vantage::OccupancyMap map({.resolution_m = 0.2, .region = world.region});
  const auto planner = vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot});
  assume_free(map, *robot, pose);

  for (std::size_t views = 1;; ++views) {
    map.insert(camera.scan(pose));
    const vantage::Plan plan = planner->plan(map, pose);
    if (plan.outcome != vantage::Outcome::Move) {
      std::cout << to_string(plan.outcome) << " after " << views << " views, " << plan.statistics.frontier_cells
                << " frontier cells are left: " << plan.reason << '\n';
      return plan.outcome == vantage::Outcome::Explored ? 0 : 1;
    }
    pose = plan.path.back();
  }
}
