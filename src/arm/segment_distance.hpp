// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace vantage {

/// Distance between two segments, each of which may be a single point. On each segment, the point nearest to the
/// other one is a linear function of the other's parameter, clamped to the ends; so two clamping steps suffice.
[[nodiscard]] inline double segment_distance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                             const Eigen::Vector3d& b0, const Eigen::Vector3d& b1) {
  const Eigen::Vector3d a = a1 - a0;
  const Eigen::Vector3d b = b1 - b0;
  const Eigen::Vector3d r = a0 - b0;
  const double aa = a.squaredNorm();
  const double bb = b.squaredNorm();
  const double ab = a.dot(b);
  constexpr double kPoint = 1e-18;
  const auto nearest_on = [](double numerator, double square) {
    return square > kPoint ? std::clamp(numerator / square, 0.0, 1.0) : 0.0;
  };
  const double across = aa * bb - ab * ab;
  double s = across > 1e-12 * aa * bb ? std::clamp((ab * b.dot(r) - bb * a.dot(r)) / across, 0.0, 1.0) : 0.0;
  const double t = nearest_on(ab * s + b.dot(r), bb);
  s = nearest_on(ab * t - a.dot(r), aa);
  return (r + s * a - t * b).norm();
}

}  // namespace vantage
