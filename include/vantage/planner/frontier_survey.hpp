// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/tried_views.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/robot/reachable_space.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A frontier cell that the sensor can resolve, and one place to do it from.
struct FrontierTarget {
  VoxelIndex frontier;  ///< the free cell
  VoxelIndex unknown;   ///< its unknown face neighbour that is to be seen
  /// A reachable cell from whose centre the centre of `unknown` is in plain sight and in range.
  VoxelIndex viewpoint;
};

/// How thoroughly a survey looks, for every planner alike.
struct FrontierSurveyOptions {
  int patience = 2;  ///< places that differ from which a cell is looked at in vain (TriedViews), >= 1
  std::size_t sight_directions = 512;  ///< directions in which an unknown cell looks back for a viewpoint, >= 6
};

/// Where the platform can go, which frontier cells are left and which of them some reachable pose can resolve: the
/// definitions of "reachable", "observable" and "leftover" that all planners share.
///
/// A frontier cell is observable if, from the centre of some reachable cell, the straight line to the centre of one
/// of its unknown face neighbours passes free cells only, none of them contested, is between the sensor's shortest
/// and longest range, and falls into its field of view in an orientation that the platform can take there. It is no
/// target if every such unknown cell was looked at in vain often enough (TriedViews).
///
/// For a sensor that does not report rays without return, targets whose unknown cell touches an occupied one (26
/// neighbours) come first, the others when none of these is left: a ray into the open teaches such a sensor nothing,
/// one along a known surface most likely meets more of it.
struct FrontierSurvey {
  ReachableSpace reachable;  ///< cells the platform can bring the sensor to
  /// The observable frontier cells to go for now, in raster order of `frontier`.
  std::vector<FrontierTarget> targets = {};
  std::size_t frontier_cells = 0;  ///< all of them, inside the region
  bool exhausted = true;   ///< false: there were too many pairs of an unknown and a reachable cell to try every one
  Leftover leftover = {};  ///< frontier cells that are no targets, by cause
  std::uint64_t ray_operations = 0;  ///< cells visited while looking for lines of sight
};

/// Surveys the map from `current`. Targets that `tried` has given up count as unobservable. Whoever surveys a map
/// again and again does it cheaper by a FrontierSurveyor.
[[nodiscard]] FrontierSurvey survey_frontiers(const OccupancyMap& map, const Platform& platform,
                                              const RangeSensor& sensor, const Pose& current,
                                              const FrontierSurveyOptions& options, const TriedViews& tried);

/// Whether the centre of `target` is in plain sight from `from`: every cell before it on the straight line is free
/// and not contested.
/// `operations` counts the cells visited.
[[nodiscard]] bool in_plain_sight(const OccupancyMap& map, const Eigen::Vector3d& from, const VoxelIndex& target,
                                  std::uint64_t& operations);

/// Whether a sensor at `pose` should resolve `unknown`: in range, in the field of view and in plain sight.
[[nodiscard]] bool sees(const OccupancyMap& map, const RangeSensor& sensor, const Pose& pose,
                        const VoxelIndex& unknown, std::uint64_t& operations);

}  // namespace vantage
