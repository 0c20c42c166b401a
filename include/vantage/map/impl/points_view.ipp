// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vantage/map/points_view.hpp>

namespace vantage {

VANTAGE_INLINE PointsView::PointsView(const void* first, std::size_t count, std::size_t stride_bytes)
    : first_(static_cast<const std::byte*>(first)), count_(count), stride_bytes_(stride_bytes) {
  if (first == nullptr && count > 0) {
    throw std::invalid_argument("PointsView: first is null, but there are " + std::to_string(count) + " points");
  }
  if (stride_bytes < kBytes) {
    throw std::invalid_argument("PointsView::stride_bytes is " + std::to_string(stride_bytes) +
                                ", must be at least 12: three floats");
  }
}

}  // namespace vantage
