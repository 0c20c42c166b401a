// SPDX-License-Identifier: MIT
// Maps the inside of a cube from one scan and plans: Explored if the cube is closed, a Move if it is open.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <vantage/vantage.hpp>

#if VANTAGE_VERSION < VANTAGE_VERSION_NUMBER(0, 1, 0) || VANTAGE_VERSION >= VANTAGE_VERSION_NUMBER(1, 0, 0)
#error "these are not the headers that were asked for"
#endif

namespace {

// A scan from the centre of a cube with walls 2.05 m away, optionally open towards its own right.
vantage::Scan scan_of_cube(const vantage::RangeSensor& sensor, const vantage::Pose& pose, bool open) {
  vantage::Scan scan;
  scan.world_from_sensor = pose;
  scan.max_range_m = 4.0;
  for (const Eigen::Vector3f& direction : sensor.directions()) {
    const Eigen::Vector3f hit = direction * (2.05F / direction.cwiseAbs().maxCoeff());
    const bool through = open && hit.x() > 2.0F && std::max(std::abs(hit.y()), std::abs(hit.z())) < 0.8F;
    (through ? scan.no_return : scan.points).push_back(through ? direction : hit);
  }
  return scan;
}

vantage::Plan plan_in_cube(bool open) {
  const vantage::RangeSensor sensor = vantage::RangeSensor::preset("panoramic");
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::Pose pose = vantage::pose_looking({0.05, 0.05, 0.05}, 0.0);
  vantage::OccupancyMap map({.resolution_m = 0.1});
  map.insert(scan_of_cube(sensor, pose, open));
  return vantage::make_planner("nearest-frontier", {.sensor = sensor, .platform = robot})->plan(map, pose);
}

}  // namespace

int main() {
  const vantage::Plan closed = plan_in_cube(false);
  const vantage::Plan open = plan_in_cube(true);
  std::cout << "vantage " << VANTAGE_VERSION_STRING << ": closed cube: " << to_string(closed.outcome) << " ("
            << closed.reason << "), open cube: " << to_string(open.outcome) << " (" << open.reason << ")\n";
  const bool as_expected = closed.outcome == vantage::Outcome::Explored && open.outcome == vantage::Outcome::Move &&
                           open.path.size() >= 2 && open.goal.pose.translation().y() < -0.5;
  return as_expected ? 0 : 1;
}
