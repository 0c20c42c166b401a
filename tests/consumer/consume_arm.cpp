// SPDX-License-Identifier: MIT
// A planar arm with two links: forward kinematics, inverse kinematics and a path through known cells.
#include <array>
#include <cmath>
#include <iostream>
#include <vantage/arm/arm.hpp>

int main() {
  const std::array<vantage::DhRow, 2> rows{vantage::DhRow{.a_m = 0.5, .range = {-1.5, 1.5}},
                                           vantage::DhRow{.a_m = 0.3, .range = {0.0, 2.5}}};
  const std::array<double, 2> joints{0.4, 0.9};
  const auto chain = vantage::KinematicChain::from_dh(
      rows, vantage::Pose::Identity(), {{.link = 2, .from_m = {-0.3, 0, 0}, .to_m = {0, 0, 0}, .radius_m = 0.03}});
  const vantage::Arm arm(chain, {.declared_clear = {{{-2, -2, -2}, {2, 2, 2}}}});

  const vantage::Pose pose = arm.sensor_pose(joints);
  const double x_m = 0.5 * std::cos(0.4) + 0.3 * std::cos(1.3);
  const auto back = arm.configuration(pose);
  const auto path = arm.path(vantage::OccupancyMap(), pose, arm.sensor_pose(std::array{-0.5, 2.0}));
  std::cout << "the sensor is at x = " << pose.translation().x() << " m; a way of " << (path ? path->size() : 0)
            << " poses\n";
  return std::abs(pose.translation().x() - x_m) < 1e-9 && back && std::abs((*back)[1] - 0.9) < 1e-4 && path &&
                 path->size() > 5
             ? 0
             : 1;
}
