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

/// An unknown cell, and a place from which it could still be observed.
struct ObservableCell {
  VoxelIndex unknown;  ///< beside a free cell
  VoxelIndex place;  ///< the sensor can be brought to its centre, and turned so that it sees the centre of `unknown`
};

/// What an `audit` found.
struct AuditResult {
  std::size_t cells_checked = 0;      ///< unknown cells beside free ones, inside the region
  std::size_t looked_at_in_vain = 0;  ///< of these, observable but in view of two poses of the run from other cells
  std::size_t observable_left = 0;    ///< of these, observable and not looked at in vain: 0 where all is explored
  std::vector<ObservableCell> left;   ///< the `observable_left` ones, in raster order
};

/// Checks by brute force what is left to observe in the map of a run that has ended: every unknown cell beside free
/// space, from every place, in every direction. It shares no code with the planners, only with what they stand on: a
/// place is the centre of a cell that the platform admits, joined face to face through such cells to one beside
/// `current` that the platform may move to. The sensor observes a cell from there if the distance of their centres is
/// within its range; every cell that the line between them touches, be it at an edge, is known to be free; and the
/// platform, turned as near to that direction as it can (Platform::facing), is admitted and has it in view.
/// `looked_from` are the poses of the run's scans. Takes time as cells times places; the same for any number of
/// threads. Throws std::invalid_argument for a sensor that is not valid, `current` or a pose that is not rigid, and
/// threads < 1.
[[nodiscard]] AuditResult audit(const OccupancyMap& map, const Platform& platform, const RangeSensor& sensor,
                                const Pose& current, std::span<const Pose> looked_from, int threads = 1);

}  // namespace vantage
