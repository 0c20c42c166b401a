// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/map/scan.hpp>

namespace vantage {

VANTAGE_INLINE Scan Scan::from_points(const PointsView& points, const Pose& world_from_sensor) {
  Scan scan;
  scan.world_from_sensor = world_from_sensor;
  scan.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    scan.points.push_back(points[i]);
  }
  return scan;
}

VANTAGE_INLINE ScanView Scan::view() const {
  return {world_from_sensor, PointsView(points), PointsView(no_return), max_range_m, width, height};
}

}  // namespace vantage
