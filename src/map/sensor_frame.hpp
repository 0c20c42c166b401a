// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vantage/geometry/pose.hpp>

namespace vantage {

/// The pose of a scan as numbers, with one order of rounding for insertion and its definition.
struct SensorFrame {
  explicit SensorFrame(const Pose& world_from_sensor) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      rotation[axis] = {world_from_sensor(row, 0), world_from_sensor(row, 1), world_from_sensor(row, 2)};
      translation[axis] = world_from_sensor(row, 3);
    }
  }

  /// A coordinate in the world of a direction in the sensor frame.
  [[nodiscard]] double rotated(std::size_t axis, double x, double y, double z) const {
    return rotation[axis][0] * x + (rotation[axis][1] * y + rotation[axis][2] * z);
  }
  /// A coordinate in the world of a point in the sensor frame.
  [[nodiscard]] double world(std::size_t axis, double x, double y, double z) const {
    return rotated(axis, x, y, z) + translation[axis];
  }
  /// The square of the distance of a point from the sensor. Of a finite point in float it is finite, and zero only
  /// there.
  [[nodiscard]] static double squared(double x, double y, double z) { return x * x + (y * y + z * z); }

  std::array<std::array<double, 3>, 3> rotation{};
  std::array<double, 3> translation{};
};

}  // namespace vantage
