// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

namespace vantage::detail {

/// Random numbers computed from the bits of an engine. The standard distributions differ between standard libraries.
class Dice {
 public:
  /// Different values of `stream` give different sequences for the same seed.
  explicit Dice(std::uint64_t seed, std::uint64_t stream = 0) : engine_(seed * 0x9E3779B97F4A7C15ULL + stream) {}

  /// A number in [0, 1).
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  /// An integer in [0, count).
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(share() * static_cast<double>(count)); }
  /// A unit vector, uniformly distributed over the sphere.
  Eigen::Vector3d direction() {
    const double z = 2.0 * share() - 1.0;
    const double angle = 2.0 * std::numbers::pi * share();
    const double level = std::sqrt(1.0 - z * z);
    return {level * std::cos(angle), level * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vantage::detail
