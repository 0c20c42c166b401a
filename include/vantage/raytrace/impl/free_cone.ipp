// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vantage/raytrace/impl/free_cone.hpp>

namespace vantage {

VANTAGE_INLINE FreeCone::FreeCone(const BlockingGrid& grid, const VoxelFrame& frame, const Pose& world_from_sensor)
    : reader_(grid),
      size_m_(frame.size_m),
      origin_(world_from_sensor.translation() / frame.size_m),
      world_from_sensor_(world_from_sensor.linear()) {}

// Steps along the axis from one cube of free words to the next. A ray of the cone at distance d from the sensor is at
// most d times the chord of the half angle away from the axis.
VANTAGE_INLINE double FreeCone::free_m(const RayCone& cone, double enough_m) {
  constexpr double kLooseness = 1e-5;  // tolerance for rotations and rounding, per cell of distance
  constexpr double kLeastStep = 2.0;   // cells; a shorter step costs more than it saves
  constexpr double kSlack = 1e-3;      // tolerance for rounding, cells
  const double chord = std::sqrt(2.0 * (1.0 - cone.cos_half_angle)) + kLooseness;
  const Eigen::Vector3d axis = world_from_sensor_ * cone.axis;
  // Inverse of the largest speed at which the cone approaches the upper and the lower faces of a cube around it.
  std::array<double, 3> per_upper{};
  std::array<double, 3> per_lower{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double along = axis[static_cast<Eigen::Index>(i)];
    constexpr double kSlowest = 1e-9;
    per_upper[i] = 1.0 / std::max(chord + along, kSlowest);
    per_lower[i] = 1.0 / std::max(chord - along, kSlowest);
  }
  const double enough = enough_m / size_m_;
  double reached = 0.0;
  while (reached < enough) {
    const Eigen::Vector3d at = origin_ + reached * axis;
    const std::array<double, 3> place{at.x(), at.y(), at.z()};
    const auto cell = [&](std::size_t i) { return static_cast<std::int32_t>(std::floor(place[i])); };
    const VoxelIndex word = BlockingGrid::word_of({cell(0), cell(1), cell(2)});
    const std::int32_t free = 4 * (reader_.distance(word) - 1);
    if (free < 0) {
      break;
    }
    const std::array<std::int32_t, 3> first{word.x * 4, word.y * 4, word.z * 4};
    const double around = reached * chord + kSlack;
    double step = enough;
    for (std::size_t i = 0; i < 3; ++i) {
      const double upper = first[i] + 4 + free - place[i] - around;
      const double lower = place[i] - (first[i] - free) - around;
      step = std::min({step, upper * per_upper[i], lower * per_lower[i]});
    }
    if (step < kLeastStep) {
      break;
    }
    reached += step;
  }
  return reached * size_m_;
}

}  // namespace vantage
