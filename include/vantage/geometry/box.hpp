// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// An axis-aligned, half-open box in metres: it contains `min` but not `max`. A default box is empty.
struct Box {
  /// Lower corner, metres; inside the box.
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  /// Upper corner, metres; outside the box.
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  /// Whether the box contains no point.
  [[nodiscard]] bool empty() const { return !(min.array() < max.array()).all(); }
  /// Whether min <= point < max on every axis.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const {
    return (point.array() >= min.array()).all() && (point.array() < max.array()).all();
  }
  /// The centre, metres.
  [[nodiscard]] Eigen::Vector3d centre() const { return 0.5 * (min + max); }
  /// Edge lengths, metres.
  [[nodiscard]] Eigen::Vector3d extent() const { return max - min; }
  /// Enlarges the box so that `point` is inside or on its border.
  void extend(const Eigen::Vector3d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  /// Distance from `point` to the box, metres; 0 inside.
  [[nodiscard]] double distance_to(const Eigen::Vector3d& point) const;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/geometry/impl/box.ipp>
#endif
