// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/points_view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A Scan whose points stay in the memory of the host; OccupancyMap::insert reads them there. Fields as in Scan.
struct ScanView {
  Pose world_from_sensor = Pose::Identity();  ///< pose of the sensor
  PointsView points = {};                     ///< returns in the sensor frame, metres
  PointsView no_return = {};                  ///< directions in the sensor frame without an obstacle in the range
  double max_range_m = std::numeric_limits<double>::infinity();  ///< range limit, metres
  std::size_t width = 0;                                         ///< columns of the depth image, or 0
  std::size_t height = 0;                                        ///< rows of the depth image, or 0

  /// Whether `points` is a depth image.
  [[nodiscard]] bool organised() const {
    return width > 0 && points.size() % width == 0 && points.size() / width == height;
  }
};

/// One measurement of a range sensor.
///
/// A pixel without a measurement (a stereo gap, a missing depth value) is a point with a NaN coordinate. It carries
/// no information: the cells along it stay unknown. A ray belongs in `no_return` only if the sensor *knows* that
/// nothing lies within its range. Such a ray clears cells up to `max_range_m`.
struct Scan {
  Pose world_from_sensor = Pose::Identity();  ///< pose of the sensor
  /// Returns in the sensor frame, metres. If `width * height == points.size()`, they form a depth image in row-major
  /// order. The map may then use the pixel neighbourhood for speed; the result is the same.
  std::vector<Eigen::Vector3f> points = {};
  /// Directions in the sensor frame (any non-zero length) without an obstacle within `max_range_m`.
  std::vector<Eigen::Vector3f> no_return = {};
  /// Range limit, metres. A return beyond it clears cells up to the limit and hits nothing. Infinite: every return is
  /// a hit.
  double max_range_m = std::numeric_limits<double>::infinity();
  std::size_t width = 0;   ///< columns of the depth image, or 0
  std::size_t height = 0;  ///< rows of the depth image, or 0

  /// A scan with a copy of these points, for a ScanLog or if the scan must outlive the memory of the host.
  [[nodiscard]] static Scan from_points(const PointsView& points, const Pose& world_from_sensor);
  /// A view of this scan; the scan must outlive it.
  [[nodiscard]] ScanView view() const;

  /// Whether `points` is a depth image.
  [[nodiscard]] bool organised() const {
    return width > 0 && points.size() % width == 0 && points.size() / width == height;
  }
};

/// Which rays are cast for the returns of a scan.
enum class RayPolicy : std::uint8_t {
  EveryReturn,  ///< one ray to each return
  EachEndCell,  ///< one ray to the centre of each cell that holds a return (OctoMap's `discretize`); faster
};

/// Statistics of an inserted scan. The first six counters classify each ray exactly once.
struct ScanReport {
  std::size_t hits = 0;             ///< returns within the range
  std::size_t beyond_range = 0;     ///< returns beyond the range; they only clear
  std::size_t no_return = 0;        ///< rays without a return; they clear up to the range
  std::size_t not_finite = 0;       ///< NaN or infinite points and directions, skipped
  std::size_t zero_length = 0;      ///< points at the sensor origin and zero directions, skipped
  std::size_t not_addressable = 0;  ///< rays that leave the addressable volume, skipped
  std::size_t cells_hit = 0;        ///< cells updated as occupied
  std::size_t cells_cleared = 0;    ///< cells updated as free
  std::size_t cells_changed = 0;    ///< cells whose state (unknown, free, occupied) changed
  /// updates refused for lack of space (OccupancyMapOptions::max_bytes, or work space of the scan)
  std::size_t cells_refused = 0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/scan.ipp>
#endif
