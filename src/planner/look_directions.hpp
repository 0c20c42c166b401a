// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/planner/situation.hpp>
#include <vantage/planner/target_view.hpp>
#include <vantage/view/unknown_sight.hpp>
#include <vector>

namespace vantage::detail {

/// A view, and how much it is expected to teach.
struct Look {
  TargetView seen;     ///< the view, and the targets in it
  double cells = 0.0;  ///< unknown cells that it is expected to resolve (UnknownSight)
};

/// Which way a sensor of a narrow view had best look from where it stands: of directions spread over the sphere, as
/// the platform can take them, the one that is expected to teach most. Directions in which none of the survey's
/// targets is in sight do not count, so a look always has a boundary to resolve, or to give up.
class LookDirections {
 public:
  /// From the place `position`. `operations` counts the cells that lines of sight visit.
  LookDirections(const Situation& situation, const Eigen::Vector3d& position, std::uint64_t& operations);

  /// The best view; with `wanted`, of those that have this cell, which must be in sight from here, in view. None if
  /// there is no such view.
  [[nodiscard]] std::optional<Look> best(const std::optional<VoxelIndex>& wanted = std::nullopt) const;

  /// Whether there is anything to choose: the sensor does not see all around, and the map is no plane, in which the
  /// rows of an image lead out of the map.
  [[nodiscard]] static bool choosable(const OccupancyMap& map, const RangeSensor& sensor);

 private:
  struct Sighting {
    VoxelIndex unknown;
    Eigen::Vector3d line;  // from here
  };
  [[nodiscard]] TargetView targets_in_view(const Pose& pose) const;
  [[nodiscard]] double expected_cells(const Pose& pose) const;
  [[nodiscard]] bool was_in_view(const VoxelIndex& cell) const;

  const Situation& situation_;
  Eigen::Vector3d position_;
  VoxelIndex place_;
  std::vector<Sighting> sightings_;
  std::optional<UnknownSight> sight_;
};

}  // namespace vantage::detail
