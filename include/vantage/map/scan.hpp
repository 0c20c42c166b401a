// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// One reading of a range sensor.
///
/// A pixel without a measurement (a stereo gap, a missing depth value) is a point with a NaN coordinate: it says
/// nothing, so what lies along it stays unknown. Only a sensor that *knows* a ray met nothing within its range lists
/// that ray in `no_return`; such a ray clears cells up to `max_range_m`.
struct Scan {
  Pose world_from_sensor = Pose::Identity();  ///< where the sensor was
  /// Returns in the sensor frame, metres. If `width * height == points.size()` they are a depth image, row by row,
  /// and the map may use the neighbourhood of pixels; the result is the same either way.
  std::vector<Eigen::Vector3f> points;
  /// Directions in the sensor frame (any non-zero length) along which nothing was met within `max_range_m`.
  std::vector<Eigen::Vector3f> no_return;
  /// Returns further than this only clear, up to this distance. Infinite: every return is a hit.
  double max_range_m = std::numeric_limits<double>::infinity();
  std::size_t width = 0;   ///< columns of an organised scan, or 0
  std::size_t height = 0;  ///< rows of an organised scan, or 0

  /// Whether `points` is a depth image.
  [[nodiscard]] bool organised() const {
    return width > 0 && points.size() % width == 0 && points.size() / width == height;
  }
};

/// What became of the rays of a scan: every one of them is counted exactly once among the first six.
struct ScanReport {
  std::size_t hits = 0;             ///< returns that ended in a cell
  std::size_t beyond_range = 0;     ///< returns beyond the range, which only cleared
  std::size_t no_return = 0;        ///< rays without a return, which cleared up to the range
  std::size_t not_finite = 0;       ///< NaN or infinite points and directions, skipped
  std::size_t zero_length = 0;      ///< points at the sensor's origin and zero directions, skipped
  std::size_t not_addressable = 0;  ///< rays that leave the addressable volume, skipped
  std::size_t cells_hit = 0;        ///< cells updated as occupied
  std::size_t cells_cleared = 0;    ///< cells updated as free
  std::size_t cells_changed = 0;    ///< cells whose state (unknown, free, occupied) changed
  std::size_t cells_refused = 0;    ///< updates that found no room (OccupancyMapOptions::max_bytes)
};

}  // namespace vantage
