// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// An axis-aligned box in metres, half-open: it holds `min` and not `max`. A default box is empty.
struct Box {
  /// Lowest corner, metres; inside.
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  /// Highest corner, metres; outside.
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  /// Whether it holds no point.
  [[nodiscard]] bool empty() const { return !(min.array() < max.array()).all(); }
  /// Whether `point` is at or above `min` and below `max` on every axis.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const {
    return (point.array() >= min.array()).all() && (point.array() < max.array()).all();
  }
  /// The middle, metres.
  [[nodiscard]] Eigen::Vector3d centre() const { return 0.5 * (min + max); }
  /// Edge lengths, metres.
  [[nodiscard]] Eigen::Vector3d extent() const { return max - min; }
  /// Grows the box until its closure holds `point`.
  void extend(const Eigen::Vector3d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  /// Distance from `point` to the nearest point of the box, 0 inside.
  [[nodiscard]] double distance_to(const Eigen::Vector3d& point) const;
};

}  // namespace vantage
