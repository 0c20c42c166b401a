// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/report/run_record.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The cells of one brick of a map as they are after a cycle that has changed some of them.
struct BrickState {
  VoxelIndex brick;          ///< its address, in units of bricks
  BrickPlane known = {};     ///< free or occupied
  BrickPlane occupied = {};  ///< a subset of `known`

  /// The same brick in the same state.
  friend bool operator==(const BrickState&, const BrickState&) = default;
};

/// A potential field at one cell: which way is down, and how high it is there.
struct FieldArrow {
  VoxelIndex cell;                                     ///< where
  Eigen::Vector3f downhill = Eigen::Vector3f::Zero();  ///< unit length, to about 1 %; zero where the field is level
  float phi = 0.0F;                                    ///< 1 at the sensor, 0 at the frontier
};

/// All that a record tells of one integrated scan and of the plan made after it.
struct RecordedCycle {
  ViewRecord view;                       ///< the scan and its numbers
  bool planned = false;                  ///< whether a plan was made after it; what follows belongs to that plan
  std::string reason = {};               ///< Plan::reason
  std::vector<Pose> path = {};           ///< Plan::path
  std::vector<View> candidates = {};     ///< Plan::candidates
  Leftover leftover = {};                ///< Plan::leftover
  double survey_ms = 0.0;                ///< PlanStatistics::survey_ms
  double choose_ms = 0.0;                ///< PlanStatistics::evaluate_ms and choose_ms
  double path_ms = 0.0;                  ///< PlanStatistics::path_ms
  std::vector<FieldArrow> field = {};    ///< samples of the planner's field, where it has one
  std::vector<BrickState> changes = {};  ///< bricks of which a cell changed its state since the cycle before
};

/// Brings `map` to the state after a cycle. The map must be in the state after the cycle before; a new map is the
/// state before the first.
void apply_changes(const RecordedCycle& cycle, OccupancyMap& map);

}  // namespace vantage
