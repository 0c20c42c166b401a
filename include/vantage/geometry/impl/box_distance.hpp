// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/box.hpp>

namespace vantage::detail {

/// Box::distance_to, inline for loops in the library.
[[nodiscard]] inline double distance_between(const Box& box, const Eigen::Vector3d& point) {
  return (box.min - point).cwiseMax(point - box.max).cwiseMax(0.0).norm();
}

}  // namespace vantage::detail
