// SPDX-License-Identifier: MIT
// Any scans, edits, poses and reports, and what each planner makes of them: a plan with a reason, whose way begins
// here and ends at a goal that the robot can take.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>

#include "fuzz_target.hpp"
#include "input_bytes.hpp"

namespace {

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

void check(const vantage::Plan& plan, const vantage::OccupancyMap& map, const vantage::Platform& platform,
           const vantage::Pose& current) {
  require(!plan.reason.empty());
  if (plan.outcome != vantage::Outcome::Move) {
    return;
  }
  require(!plan.path.empty() && plan.path.front().matrix() == current.matrix() &&
          plan.path.back().matrix() == plan.goal.pose.matrix());
  const bool turns = plan.goal.pose.translation() == current.translation();  // all that a robot that is stuck can do
  require(turns || platform.admits(map, plan.goal.pose));
}

}  // namespace

std::vector<std::string> vantage::fuzz::seeds() { return random_seeds(120); }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using vantage::VoxelBox;
  using vantage::VoxelIndex;
  vantage::fuzz::InputBytes input(data, std::min<std::size_t>(size, 160));
  const auto names = vantage::planner_names();
  const auto number = std::size_t{input.byte()} % names.size();
  const auto platform = std::make_shared<const vantage::FreeFlyer>(
      vantage::FreeFlyerOptions{.radius_m = 0.05 * (input.byte() % 6), .yaw_only = input.byte() % 2 == 0});
  const vantage::RangeSensor sensor =
      input.byte() % 2 == 0 ? vantage::RangeSensor::pinhole(24, 18, 1.0, 0.8, 0.1, 3.0)
                            : vantage::RangeSensor::spherical(36, 18, 2.0 * std::numbers::pi, 2.0, 0.0, 2.0);
  const auto planner = vantage::make_planner(*std::next(names.begin(), static_cast<std::ptrdiff_t>(number)),
                                             {.sensor = sensor, .platform = platform});
  vantage::OccupancyMapOptions options{.resolution_m = 0.2};
  if (input.byte() % 2 == 0) {
    options.region = vantage::Box{{-4.0, -4.0, -2.0}, {4.0, 4.0, 2.0}};
  }
  options.max_bytes = input.byte() % 4 == 0 ? 60'000 : 0;
  vantage::OccupancyMap map(options);
  vantage::Pose current = vantage::pose_looking({0.1, 0.1, 0.1}, 0.0);
  if (input.byte() % 4 != 0) {
    map.set_log_odds(VoxelBox{{-5, -5, -3}, {6, 6, 4}}, -2.0);
  }
  const auto box = [&] {
    const VoxelIndex lo{input.small() / 8, input.small() / 8, input.small() / 16};
    return VoxelBox{lo, lo + VoxelIndex{1 + input.byte() % 12, 1 + input.byte() % 12, 1 + input.byte() % 6}};
  };
  for (int steps = 0; !input.empty() && steps < 24; ++steps) {
    switch (input.byte() % 8) {
      case 0:
        map.set_log_odds(box(), 3.5);
        break;
      case 1:
      case 2:
        map.set_log_odds(box(), -2.0);
        break;
      case 3:
        for_each_cell(box(), [&](const VoxelIndex& cell) { map.set(cell, vantage::Occupancy::Unknown); });
        break;
      case 4: {
        vantage::Scan scan;
        scan.world_from_sensor = current;
        scan.max_range_m = 3.0;
        for (int i = input.byte() % 16; i >= 0; --i) {
          const Eigen::Vector3d point(0.02 * input.small(), 0.02 * input.small(), 0.02 * input.small());
          (i % 3 == 0 ? scan.no_return : scan.points).push_back(point.cast<float>());
        }
        map.insert(scan);
        break;
      }
      case 5:
        current = vantage::pose_looking({0.04 * input.small(), 0.04 * input.small(), 0.02 * input.small()},
                                        0.03 * input.small());
        break;
      case 6:
        planner->report(map, current, static_cast<vantage::GoalResult>(input.byte() % 3));
        break;
      default: {
        const vantage::Plan plan = planner->plan(map, current);
        check(plan, map, *platform, current);
        if (plan.outcome == vantage::Outcome::Move) {
          current = plan.goal.pose;
        }
      }
    }
  }
  check(planner->plan(map, current), map, *platform, current);
  return 0;
}
