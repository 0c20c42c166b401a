// SPDX-License-Identifier: MIT
// How does an arm search, whose host has a motion planner? The planner chooses the view; the host's planner moves the
// joints. Here: an interpolation of the joints takes the place of the host's planner.
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <vantage/arm/arm.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/wrapped_platform.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vector>

// An arm in all respects but its paths.
class HostArm final : public vantage::WrappedPlatform {
 public:
  explicit HostArm(const std::shared_ptr<const vantage::Arm>& arm) : WrappedPlatform(arm), arm_(arm) {}

  // The motion planner of the host goes here. A view without a path is not chosen.
  std::optional<std::vector<vantage::Pose>> path(const vantage::OccupancyMap& map, const vantage::Pose& from,
                                                 const vantage::Pose& to) const override {
    constexpr std::size_t kSteps = 20;
    const auto first = arm_->configuration(from);
    const auto last = arm_->configuration(to);
    if (!first || !last || !arm_->admits(map, to) || !arm_->admits_motion(map, from, to)) {
      return std::nullopt;
    }
    std::vector<vantage::Pose> path{from};
    for (std::size_t step = 1; step < kSteps; ++step) {
      const double share = static_cast<double>(step) / kSteps;
      vantage::Joints joints = *first;
      std::transform(first->begin(), first->end(), last->begin(), joints.begin(),
                     [share](double a, double b) { return a + share * (b - a); });
      path.push_back(arm_->sensor_pose(joints));
    }
    path.push_back(to);
    return path;
  }
  vantage::VoxelGrid<std::uint8_t> admitted_cells(const vantage::OccupancyMap& map,
                                                  const vantage::VoxelBox& box) const override {
    return arm_->admitted_cells(map, box);
  }

 private:
  std::shared_ptr<const vantage::Arm> arm_;
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
  std::cout << to_string(record.outcome) << " after " << record.views.size() << " views and "
            << record.path_length_m() << " m of the sensor\n";
}
