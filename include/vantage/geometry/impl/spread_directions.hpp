// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace vantage::detail {

inline constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896964);

/// Unit vectors in the plane z = 0, distributed about uniformly, and so are the first of them.
[[nodiscard]] inline std::vector<Eigen::Vector3d> level_directions(std::size_t count) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = kGoldenAngle * static_cast<double>(i);
    directions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  return directions;
}

/// Uniformly distributed unit vectors: a Fibonacci lattice on the sphere.
[[nodiscard]] inline std::vector<Eigen::Vector3d> spread_directions(std::size_t count) {
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = kGoldenAngle * static_cast<double>(i);
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

}  // namespace vantage::detail
