// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vantage/view/target_view.hpp>
#include <vector>

namespace vantage::detail {

/// Range, metres, within which a view counts targets: cells beyond the resolving range may lie between the rays.
[[nodiscard]] inline double counted_range_m(const OccupancyMap& map, const RangeSensor& sensor) {
  return std::min(sensor.max_range_m, sensor.resolving_range_m(map.resolution_m()));
}

/// Those of some targets that are in clear line of sight from a place, whatever the orientation. Targets whose
/// viewpoint this is are in sight, if only in part.
class TargetsInSight {
 public:
  struct Sighting {
    VoxelIndex unknown;
    Eigen::Vector3d line;  ///< from the place to the centre of the cell, metres, world
  };

  /// Finds those of `targets` in sight of `position` (metres, world), up to `furthest_m`. Adds the number of visited
  /// cells to `operations`.
  TargetsInSight(const SurveyedMap& surveyed, std::span<const FrontierTarget> targets,
                 const Eigen::Vector3d& position, double furthest_m, std::uint64_t& operations);

  /// Those in the field of view of a sensor at this place, turned as in `pose`.
  [[nodiscard]] TargetView in_view(const Pose& pose) const;
  /// All of them, in the order of the targets.
  [[nodiscard]] const std::vector<Sighting>& all() const { return sightings_; }
  /// Leaves out the targets whose unknown cell was looked at in vain from the place.
  void leave_out_tried();

 private:
  const RangeSensor& sensor_;
  const TriedViews& tried_;
  VoxelIndex place_;
  std::vector<Sighting> sightings_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/targets_in_sight.ipp>
#endif
