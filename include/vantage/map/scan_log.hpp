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

/// The scans that a map was made of, so that it can be made again when poses turn out to have been others: a loop was
/// closed, a scan was registered.
///
///     ScanLog log({.resolution_m = 0.05});
///     log.insert(scan);                    // as map.insert(scan)
///     log.correct(corrected_poses);        // one per scan; the map is made again
///
/// The map after `correct` is cell for cell, log-odds included, the one that the right poses would have made from the
/// start.
class ScanLog {
 public:
  /// Errors as OccupancyMap.
  explicit ScanLog(const OccupancyMapOptions& options, RayPolicy policy = RayPolicy::EveryReturn);

  /// Keeps a scan and inserts it into the map. Errors as OccupancyMap::insert; a scan refused is not kept.
  ScanReport insert(Scan scan);
  /// Gives every scan, in the order of insertion, a new pose and makes the map again: another object at another
  /// place, so that planners and other readers start anew. If no pose differs, all stays as it is. Throws
  /// std::invalid_argument unless there is one rigid pose per scan; the log is then unchanged. Returns how many poses
  /// were new.
  std::size_t correct(std::span<const Pose> world_from_sensor);

  /// The map of all scans; the reference holds until `correct`.
  [[nodiscard]] const OccupancyMap& map() const { return *map_; }
  /// The scans, in order of insertion.
  [[nodiscard]] const std::vector<Scan>& scans() const { return scans_; }

 private:
  RayPolicy policy_;
  std::unique_ptr<OccupancyMap> map_;
  std::vector<Scan> scans_;
};

}  // namespace vantage
