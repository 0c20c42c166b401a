// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <unordered_map>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace vantage {

/// Remembers which unknown cells did not resolve though the sensor looked at them, so that no planner stares forever at
/// what its sensor cannot measure (a surface that gives no stereo match, the open sky). A planner's only memory beside
/// the map; without it a resumed planner merely tries once more.
///
/// A cell is given up after `patience` views that should have seen it. The memory decays: when anything within the
/// cell's brick changes, its count starts anew.
class FailedViews {
 public:
  /// A cell is given up after `patience` fruitless views, > 0.
  explicit FailedViews(int patience = 2) : patience_(patience) {}

  /// Announces that a view from `pose` is meant to resolve these cells.
  void expect(const OccupancyMap& map, const Pose& pose, std::vector<VoxelIndex> unknown_cells);
  /// Looks at the map now. If the map has changed since `expect` and the sensor is where the view was to be taken,
  /// cells still unknown count one failure more. A second call without a change of the map does nothing.
  void review(const OccupancyMap& map, const Pose& current);
  /// Whether a view of this unknown cell has failed too often.
  [[nodiscard]] bool gave_up(const VoxelIndex& unknown) const;
  /// How many cells have been given up.
  [[nodiscard]] std::size_t size() const { return failures_.size(); }

 private:
  struct Expectation {
    Pose pose;
    OccupancyMap::Revision revision;
    std::vector<VoxelIndex> cells;
  };

  int patience_;
  std::optional<Expectation> expected_;
  std::optional<OccupancyMap::Revision> reviewed_;
  std::unordered_map<VoxelIndex, int> failures_;
};

}  // namespace vantage
