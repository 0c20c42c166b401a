// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vantage/geometry/pose.hpp>

namespace vantage::detail {

/// The pose of a scan as plain numbers. Insertion and its reference implementation share its order of operations, so
/// both round in the same way.
struct SensorFrame {
  explicit SensorFrame(const Pose& world_from_sensor) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Eigen::Index>(axis);
      rotation[axis] = {world_from_sensor(row, 0), world_from_sensor(row, 1), world_from_sensor(row, 2)};
      translation[axis] = world_from_sensor(row, 3);
    }
  }

  /// World coordinate `axis` of a direction in the sensor frame.
  [[nodiscard]] double rotated(std::size_t axis, double x, double y, double z) const {
    return rotation[axis][0] * x + (rotation[axis][1] * y + rotation[axis][2] * z);
  }
  /// World coordinate `axis` of a point in the sensor frame.
  [[nodiscard]] double world(std::size_t axis, double x, double y, double z) const {
    return rotated(axis, x, y, z) + translation[axis];
  }
  /// Squared distance of a point in the sensor frame from the sensor. For a finite single-precision point it is
  /// finite, and zero only at the sensor.
  [[nodiscard]] static double squared(double x, double y, double z) { return x * x + (y * y + z * z); }

  std::array<std::array<double, 3>, 3> rotation{};
  std::array<double, 3> translation{};
};

}  // namespace vantage::detail
