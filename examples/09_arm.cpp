// SPDX-License-Identifier: MIT
// How does an arm search, whose host has a motion planner? The planner chooses the view; the host's planner moves the
// joints. Here: an interpolation of the joints takes the place of the host's planner.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <vantage/arm/arm.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/wrapped_platform.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vector>

// An arm in all respects but its paths.
struct HostArm final : vantage::WrappedPlatform {
  std::shared_ptr<const vantage::Arm> arm;

  explicit HostArm(const std::shared_ptr<const vantage::Arm>& own) : WrappedPlatform(own), arm(own) {}

  // The motion planner of the host goes here. A view without a path is not chosen.
  std::optional<std::vector<vantage::Pose>> path(const vantage::OccupancyMap& map, const vantage::Pose& from,
                                                 const vantage::Pose& to) const override {
    const auto first = arm->configuration(from);
    const auto last = arm->configuration(to);
    if (!first || !last || !arm->admits(map, to) || !arm->admits_motion(map, from, to)) {
      return std::nullopt;
    }
    std::vector<vantage::Pose> path{from};
    for (const double share : {0.2, 0.4, 0.6, 0.8}) {
      vantage::Joints joints = *first;
      std::transform(first->begin(), first->end(), last->begin(), joints.begin(),
                     [share](double a, double b) { return std::lerp(a, b, share); });
      path.push_back(arm->sensor_pose(joints));
    }
    path.push_back(to);
    return path;
  }
};

int main(int, char** arguments) {
  const auto chain = vantage::KinematicChain::from_urdf(arguments[1], "base_link", "sensor");
  const vantage::Joints joints{0.0, -0.7, 1.5, 0.0, 0.0};
  const vantage::Box beside_the_base{{-0.4, -0.4, 0.0}, {0.5, 0.4, 1.2}};
  const auto arm = std::make_shared<vantage::Arm>(chain, vantage::ArmOptions{.declared_clear = {beside_the_base}});
  const auto robot = std::make_shared<HostArm>(arm);
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("kinect");
  const vantage::World world = vantage::World::by_name("crates-open");
  const auto planner = vantage::make_planner("frontier-void", {.sensor = sensor, .platform = robot},
                                             {{"mode", "searching"}, {"views", "100"}, {"least_view_m3", "0.001"}});
  vantage::ExplorationRun run(world, sensor, robot,
                              {.map = {.resolution_m = 0.05},
                               .max_views = 5,
                               .scan_spacing_m = 0.0,
                               .measure_coverage = false,
                               .unknown_box = world.searched,
                               .declared_clear = {beside_the_base}});
  const vantage::RunRecord record = run.run(*planner, arm->sensor_pose(joints));
  std::cout << "after " << record.views.size() << " views and " << record.path_length_m() << " m of the sensor\n";
}
