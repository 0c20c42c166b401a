// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vantage/geometry/pose.hpp>
#include <vector>

namespace vantage::detail {

/// The angle between the optical axes of two sensor poses, radians.
[[nodiscard]] inline double angle_rad(const Pose& a, const Pose& b) {
  return std::acos(std::clamp(optical_axis(a).dot(optical_axis(b)), -1.0, 1.0));
}

/// The length of a path, metres.
[[nodiscard]] inline double length_m(const std::vector<Pose>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length_m += (path[i].translation() - path[i - 1].translation()).norm();
  }
  return length_m;
}

}  // namespace vantage::detail
