// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vantage/view/leftover.hpp>
#include <vantage/view/tried_views.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A frontier cell that the sensor can resolve, and one place from which it can.
struct FrontierTarget {
  VoxelIndex frontier;  ///< the free cell
  VoxelIndex unknown;   ///< the unknown face neighbour to observe
  /// A reachable cell from whose centre `unknown` is in range and in clear line of sight, at least in part.
  VoxelIndex viewpoint;
};

/// Options of a survey, common to all planners.
struct FrontierSurveyOptions {
  /// Number of different places from which a cell is looked at in vain before it is given up (TriedViews), >= 1
  int patience = 2;
  std::size_t sight_directions = 512;  ///< rays cast from an unknown cell to find a viewpoint, >= 6
};

/// What is reachable, which frontier cells are left, and which of them can be observed. All planners share these
/// definitions.
///
///     V . . . . . . . . . f u      V  viewpoint, a reachable cell     f  frontier cell (free)
///                                  .  line of sight, free cells        u  its unknown face neighbour
///
/// A frontier cell is observable if a viewpoint for one of its unknown face neighbours exists: a reachable cell such
/// that the line between both centres passes only free cells, its length is within the
/// range of the sensor, and it lies in the field of view in an orientation that the platform can take there. Unknown
/// cells that are given up (TriedViews) do not count, nor do viewpoints that rest. For a sensor that looks all
/// around, a frontier cell without such a viewpoint is observable, too, if an unknown neighbour is seen in part: the
/// line ends at the centre of one of its faces. For another sensor, these are taken only when no others are left. If
/// there are none either, one is taken where a line to an unknown neighbour passes another unknown cell beside it, if
/// only at a corner, which then becomes known.
///
/// For a sensor that does not report missing returns, the targets are only those whose unknown cell touches an
/// occupied cell (26 neighbours), as long as there are any: such a sensor observes nothing along a ray into open
/// space, while a ray along a known surface probably hits more of it.
struct FrontierSurvey {
  /// The observable frontier cells to go for now, in raster order of `frontier`.
  std::vector<FrontierTarget> targets = {};
  std::size_t frontier_cells = 0;  ///< number of all frontier cells in the region
  /// False if the space was too large to test every place for the centre of each unknown cell.
  bool exhausted = true;
  Leftover leftover = {};            ///< frontier cells that are no targets, by cause
  std::uint64_t ray_operations = 0;  ///< cells visited in the search for lines of sight

  /// The viewpoint of each target; several targets may share one.
  [[nodiscard]] std::vector<VoxelIndex> viewpoints() const;
  /// The first target with this viewpoint.
  [[nodiscard]] std::optional<FrontierTarget> target_seen_from(const VoxelIndex& viewpoint) const;
};

/// Whether there is a clear line of sight from `from` (metres, world) to the centre of `target`: every cell on the
/// line before `target` is free. Adds the number of visited cells to `operations`.
[[nodiscard]] bool in_plain_sight(const OccupancyMap& map, const Eigen::Vector3d& from, const VoxelIndex& target,
                                  std::uint64_t& operations);

/// Whether a sensor at `pose` (world_from_sensor) should resolve `unknown`: its centre is in range, in the field of
/// view and in clear line of sight. Adds the number of visited cells to `operations`.
[[nodiscard]] bool sees(const OccupancyMap& map, const RangeSensor& sensor, const Pose& pose,
                        const VoxelIndex& unknown, std::uint64_t& operations);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/frontier_survey.ipp>
#endif
