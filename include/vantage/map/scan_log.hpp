// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Keeps the scans of a map, so that the map can be rebuilt when their poses are corrected, for example after a loop
/// closure or a registration.
///
///     ScanLog log({.resolution_m = 0.05});
///     log.insert(scan);                    // as map.insert(scan)
///     log.correct(corrected_poses);        // one per scan; rebuilds the map
///
/// After `correct`, the map equals, cell for cell and log-odds included, the map that the corrected poses would have
/// built.
class ScanLog {
 public:
  /// Starts without scans and with an empty map. Errors as OccupancyMap.
  explicit ScanLog(const OccupancyMapOptions& options, RayPolicy policy = RayPolicy::EveryReturn);

  /// Inserts a scan into the map and keeps it. Errors as OccupancyMap::insert; a rejected scan is not kept.
  ScanReport insert(Scan scan);
  /// Sets a new pose for every scan, in order of insertion, and rebuilds the map if a pose differs. The rebuilt map
  /// is a new object, so planners and other readers start from the beginning. Returns the number of poses that
  /// differ. Throws std::invalid_argument if the number of poses is wrong or a pose is not rigid; the log is then
  /// unchanged.
  std::size_t correct(std::span<const Pose> world_from_sensor);

  /// The map of all scans. The reference is valid until `correct` rebuilds the map.
  [[nodiscard]] const OccupancyMap& map() const { return *map_; }
  /// The scans, in order of insertion.
  [[nodiscard]] const std::vector<Scan>& scans() const { return scans_; }

 private:
  RayPolicy policy_;
  std::unique_ptr<OccupancyMap> map_;
  std::vector<Scan> scans_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/scan_log.ipp>
#endif
