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

/// The cells of one brick of a map after a cycle that changed some of them.
struct BrickState {
  VoxelIndex brick;          ///< address of the brick, in units of bricks
  BrickPlane known = {};     ///< cells that are free or occupied
  BrickPlane occupied = {};  ///< cells that are occupied; a subset of `known`

  /// Whether address and both planes are equal.
  friend bool operator==(const BrickState&, const BrickState&) = default;
};

/// The potential field of a planner at one cell.
struct FieldArrow {
  VoxelIndex cell;                                     ///< the sampled cell
  Eigen::Vector3f downhill = Eigen::Vector3f::Zero();  ///< unit direction of descent in the world frame, to about 1
                                                       ///< %; zero where the field is level
  float phi = 0.0F;                                    ///< potential: 1 at the sensor, 0 at a frontier
};

/// What a record holds of one integrated scan and of the plan made after it.
struct RecordedCycle {
  ViewRecord view;              ///< number, pose and measured values of the scan
  bool planned = false;         ///< whether a plan was made after this scan; the fields below belong to that plan
  std::string reason = {};      ///< Plan::reason
  std::vector<Pose> path = {};  ///< Plan::path
  std::vector<View> candidates = {};     ///< Plan::candidates
  Leftover leftover = {};                ///< Plan::leftover
  double survey_ms = 0.0;                ///< PlanStatistics::survey_ms
  double choose_ms = 0.0;                ///< PlanStatistics::evaluate_ms and choose_ms
  double path_ms = 0.0;                  ///< PlanStatistics::path_ms
  std::vector<FieldArrow> field = {};    ///< samples of the planner's potential field; empty: the planner has none
  std::vector<BrickState> changes = {};  ///< bricks with a cell that changed its state since the previous cycle
};

/// Brings `map` to its state after a cycle. The map must be in the state after the previous cycle; a new map is
/// the state before the first.
void apply_changes(const RecordedCycle& cycle, OccupancyMap& map);

}  // namespace vantage
