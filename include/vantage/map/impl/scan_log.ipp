// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/map/scan_log.hpp>

namespace vantage {

VANTAGE_INLINE ScanLog::ScanLog(const OccupancyMapOptions& options, RayPolicy policy)
    : policy_(policy), map_(std::make_unique<OccupancyMap>(options)) {}

VANTAGE_INLINE ScanReport ScanLog::insert(Scan scan) {
  const ScanReport report = map_->insert(scan, policy_);
  scans_.push_back(std::move(scan));
  return report;
}

VANTAGE_INLINE std::size_t ScanLog::correct(std::span<const Pose> world_from_sensor) {
  if (world_from_sensor.size() != scans_.size()) {
    throw std::invalid_argument("ScanLog::correct: there are " + std::to_string(world_from_sensor.size()) +
                                " poses for " + std::to_string(scans_.size()) + " scans");
  }
  std::size_t moved = 0;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    if (!is_rigid(world_from_sensor[i])) {
      throw std::invalid_argument("ScanLog::correct: pose " + std::to_string(i) + " is not a rigid transform");
    }
    moved += world_from_sensor[i].matrix() != scans_[i].world_from_sensor.matrix() ? 1U : 0U;
  }
  if (moved == 0) {
    return 0;
  }
  auto again = std::make_unique<OccupancyMap>(
      map_->options());  // a scan cannot be removed from a map, because clamping loses information
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    scans_[i].world_from_sensor = world_from_sensor[i];
    again->insert(scans_[i], policy_);
  }
  map_ = std::move(again);
  return moved;
}

}  // namespace vantage
