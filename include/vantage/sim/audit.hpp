// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// An unknown cell and a place from which it can still be observed.
struct ObservableCell {
  VoxelIndex unknown;  ///< the cell; beside a free one
  VoxelIndex
      place;  ///< a cell to whose centre the sensor can be brought, and from which it sees the centre of `unknown`
};

/// Result of `audit`.
struct AuditResult {
  std::size_t cells_checked = 0;  ///< unknown cells beside free ones, inside the region
  /// Checked cells that are observable, but were already in view of poses of the run: from two cells, or from each
  /// place that sees them or a cell that touches it.
  std::size_t looked_at_in_vain = 0;
  std::size_t observable_left = 0;   ///< checked cells that are observable and not in `looked_at_in_vain`
  std::vector<ObservableCell> left;  ///< the `observable_left` cells, in raster order
};

/// Checks by brute force what can still be observed in the map of a finished run: every unknown cell beside free
/// space, from every place, in every direction. It shares no code with the planners, only map, platform and
/// sensor.
///
/// A place is the centre of an admitted cell that is joined face to face, through admitted cells, with a cell
/// beside `current` to which the platform may move. The sensor observes a cell from a place if
/// - the distance of the two centres is within its range,
/// - every cell that the line between the centres touches, even at an edge, is free, and
/// - the platform, turned towards the cell as far as it can (Platform::facing), is admitted and has the cell in
///   its field of view.
///
/// `looked_from` are the poses of the run's scans. The run time grows with cells times places; the result is the
/// same for any number of threads. Throws std::invalid_argument for an invalid sensor, a pose that is not rigid,
/// and threads < 1.
[[nodiscard]] AuditResult audit(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                                const Pose& current, std::span<const Pose> looked_from, int threads = 1);

}  // namespace vantage
