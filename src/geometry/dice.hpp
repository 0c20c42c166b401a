// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

namespace vantage {

/// Draws of our own from an engine's bits: the standard distributions differ from library to library.
class Dice {
 public:
  /// Another `stream` of the same seed draws something else.
  explicit Dice(std::uint64_t seed, std::uint64_t stream = 0) : engine_(seed * 0x9E3779B97F4A7C15ULL + stream) {}

  /// In [0, 1).
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  /// In [0, count).
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(share() * static_cast<double>(count)); }
  /// A unit vector, any as likely as any other.
  Eigen::Vector3d direction() {
    const double z = 2.0 * share() - 1.0;
    const double angle = 2.0 * std::numbers::pi * share();
    const double level = std::sqrt(1.0 - z * z);
    return {level * std::cos(angle), level * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vantage
