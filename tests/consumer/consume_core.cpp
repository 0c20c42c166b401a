// SPDX-License-Identifier: MIT
// Maps the inside of a cube from one scan and plans: Explored if the cube is closed, a Move if it is open. Then the
// host of the README explores a room with a pillar, in large cells, because this may be compiled without
// optimisation.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
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

// A robot with a perfect sensor and controller in a room of 4 x 3 x 2.4 m, in the middle of which a pillar stands.
class Robot {
 public:
  explicit Robot(const vantage::RangeSensor& sensor) : sensor_(sensor) {}

  int scans = 0;

  [[nodiscard]] const vantage::Pose& pose() const { return pose_; }
  void drive_to(const vantage::Pose& next) { pose_ = next; }
  [[nodiscard]] vantage::Scan scan() {
    ++scans;
    vantage::Scan scan;
    scan.world_from_sensor = pose_;
    scan.max_range_m = sensor_.max_range_m;
    for (const Eigen::Vector3f& direction : sensor_.directions()) {
      scan.points.push_back(direction * static_cast<float>(range_m(pose_.linear() * direction.cast<double>())));
    }
    return scan;
  }

 private:
  [[nodiscard]] double range_m(const Eigen::Vector3d& ray) const {
    const auto in_and_out_m = [&](const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
      const Eigen::Array3d a = (lo - pose_.translation()).array() / ray.array();
      const Eigen::Array3d b = (hi - pose_.translation()).array() / ray.array();
      return std::pair(a.min(b).maxCoeff(), a.max(b).minCoeff());
    };
    const double wall_m = in_and_out_m(Eigen::Vector3d::Zero(), {4.0, 3.0, 2.4}).second;
    const auto [in_m, out_m] = in_and_out_m({1.7, 1.2, -1.0}, {2.3, 1.8, 3.4});
    return (in_m > 0.0 && in_m < out_m ? in_m : wall_m) + 0.01;  // a little inside the surface
  }

  vantage::RangeSensor sensor_;
  vantage::Pose pose_ = vantage::pose_looking({0.65, 1.45, 1.15}, 0.1);
};

std::string explore(Robot& robot, const vantage::RangeSensor& sensor) {
  const auto body = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.3});
  vantage::OccupancyMap map({.resolution_m = 0.2});
  const auto planner = vantage::make_planner("harmonic", {.sensor = sensor, .platform = body});
  assume_free(map, *body, robot.pose(), start_clearance_m(map, *body, sensor));
  map.insert(robot.scan());
  for (;;) {
    const vantage::Plan plan = planner->plan(map, robot.pose());
    if (plan.outcome != vantage::Outcome::Move) {
      return plan.reason;
    }
    for (const vantage::Pose& next : plan.path) {
      robot.drive_to(next);
      map.insert(robot.scan());
      if (check(plan, map, *body, robot.pose()) != vantage::PlanCheck::Good) {
        break;
      }
    }
  }
}

}  // namespace

int main() {
  const vantage::Plan closed = plan_in_cube(false);
  const vantage::Plan open = plan_in_cube(true);
  std::cout << "vantage " << VANTAGE_VERSION_STRING << ": closed cube: " << to_string(closed.outcome) << " ("
            << closed.reason << "), open cube: " << to_string(open.outcome) << " (" << open.reason << ")\n";
  const bool as_expected = closed.outcome == vantage::Outcome::Explored && open.outcome == vantage::Outcome::Move &&
                           open.path.size() >= 2 && open.goal.pose.translation().y() < -0.5;
  const vantage::RangeSensor sensor = vantage::RangeSensor::spherical(90, 45, 6.28, 3.14, 0.0, 6.0);
  Robot robot(sensor);
  const std::string reason = explore(robot, sensor);
  std::cout << "room with a pillar: " << robot.scans << " scans, " << reason << "\n";
  return as_expected && robot.scans > 2 && reason.find("frontier is left") != std::string::npos ? 0 : 1;
}
