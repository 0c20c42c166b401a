// SPDX-License-Identifier: MIT
#include <stdexcept>
#include <string>
#include <vantage/map/points_view.hpp>
#include <vantage/map/scan.hpp>

namespace vantage {

PointsView::PointsView(const void* first, std::size_t count, std::size_t stride_bytes)
    : first_(static_cast<const std::byte*>(first)), count_(count), stride_bytes_(stride_bytes) {
  if (first == nullptr && count > 0) {
    throw std::invalid_argument("PointsView: first is null, but there are " + std::to_string(count) + " points");
  }
  if (stride_bytes < kBytes) {
    throw std::invalid_argument("PointsView::stride_bytes is " + std::to_string(stride_bytes) +
                                ", must be at least 12: three floats");
  }
}

Scan Scan::from_points(const PointsView& points, const Pose& world_from_sensor) {
  Scan scan;
  scan.world_from_sensor = world_from_sensor;
  scan.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    scan.points.push_back(points[i]);
  }
  return scan;
}

ScanView Scan::view() const {
  return {world_from_sensor, PointsView(points), PointsView(no_return), max_range_m, width, height};
}

}  // namespace vantage
