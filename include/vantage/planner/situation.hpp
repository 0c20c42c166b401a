// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_tracker.hpp>
#include <vantage/map/following.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/planner_setup.hpp>
#include <vantage/raytrace/following_caster.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/frontier_surveyor.hpp>
#include <vantage/view/target_view.hpp>
#include <vantage/view/tried_views.hpp>
#include <vector>

namespace vantage::detail {
class BlockWays;
}  // namespace vantage::detail

namespace VANTAGE_EXPORT vantage {

/// The input of a plan: the map and its frontier, the reachable space, the observable frontier cells with their
/// viewpoints, and the memory of tried views. A planner owns one and updates it once per plan; the strategy only
/// reads it.
///
///     sync(map, current)
///       |  FrontierTracker   frontier cells, from the change log of the map
///       |  TriedViews        what became of the last view; unknown cells in sight after the scan
///       |  FrontierSurveyor  admitted cells -> reachable space -> targets
///       |                    (no target left: places that rest are allowed again, one more survey)
///       |                    targets in refused directions wait until others are gone
///       v
///     end()  --- no target --->  Explored | Unreachable | Blocked | a turn, a step or another look (Move)
///       |
///       v  targets
///     strategy chooses ---> no path to the view: drop(view), choose again
///       |                   no target left: look_elsewhere(), choose again
///       |
///       v
///     remember(plan) ------> the robot comes no nearer to this goal: its place rests, choose again
///       |                    TriedViews expects the result of this view
///       v
///     Move
///
///     situation.sync(map, current);
///     if (std::optional<Plan> end = situation.end()) return *end;
///     const FrontierTarget& target = situation.survey().targets.front();
class Situation {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit Situation(const PlannerSetup& setup, const FrontierSurveyOptions& options = {});

  /// Updates everything for this map and sensor pose (world_from_sensor). Only the map must outlive the plan. Throws
  /// std::invalid_argument unless `current` is finite and rigid up to 1e-3.
  void sync(const OccupancyMap& map, const Pose& current);
  /// If no target is left: the plan that ends the run, or that turns the sensor on the spot, steps aside or looks
  /// closely at cells that were looked at in vain (TriedViews::looked_closely), or again at contested cells in the
  /// way to a place with more to see. If the robot does not move (TriedViews::is_stuck) and every target lies in a
  /// refused direction: a Blocked plan. Otherwise none. Leftover and counts of the plan are those of the survey.
  [[nodiscard]] std::optional<Plan> end();
  /// Removes, for this plan, the targets that are seen by a view to which no path leads, and those with the same
  /// viewpoint. Returns whether there were any.
  bool drop(const TargetView& view);
  /// The places of dropped views rest, at most 256 in a plan, and `survey()` holds the targets that are seen from
  /// elsewhere. So a body that has no room to look from one place looks from another. Returns false if no further
  /// place rests.
  bool look_elsewhere();
  /// Stores this plan for the next `sync`; `hoped` as in TriedViews::expect. Returns false if the robot comes no
  /// nearer to the goal: the goal then rests, and `survey()` holds the targets that are left.
  [[nodiscard]] bool remember(const Plan& plan, std::vector<VoxelIndex> hoped);

  /// The setup of the planner.
  [[nodiscard]] const PlannerSetup& setup() const { return setup_; }
  /// The body that carries the sensor.
  [[nodiscard]] const Platform& platform() const { return *setup_.platform; }
  /// The sensor model.
  [[nodiscard]] const RangeSensor& sensor() const { return setup_.sensor; }
  /// The map of the last `sync`.
  [[nodiscard]] const OccupancyMap& map() const { return *map_; }
  /// The sensor pose (world_from_sensor) of the last `sync`, with an orthonormal rotation.
  [[nodiscard]] const Pose& current() const { return current_; }
  /// Observable frontier cells with their viewpoints.
  [[nodiscard]] const FrontierSurvey& survey() const { return survey_; }
  /// The cells to which the platform can bring the sensor.
  [[nodiscard]] const ReachableSpace& reachable() const { return surveyor_.reachable(); }
  /// Frontier cells and their clusters.
  [[nodiscard]] const FrontierTracker& frontier() const { return *frontier_; }
  /// All frontier cells in raster order.
  [[nodiscard]] const std::vector<VoxelIndex>& frontier_cells() const { return frontier_cells_; }
  /// The memory of tried views.
  [[nodiscard]] const TriedViews& tried() const { return tried_; }
  /// The goal (world_from_sensor) to which the robot is moving, see TriedViews::goal_ahead, if it can still be
  /// reached.
  [[nodiscard]] std::optional<Pose> goal_ahead() const;
  /// Stores how following the last plan ended.
  void report(GoalResult result) { tried_.report(result); }
  /// Replaces the memory of tried views, see TriedViews::recall.
  void recall(const OccupancyMap& map, std::string_view memory) { tried_.recall(map, memory); }
  /// References to the map, the robot and the results of the survey, valid until the next `sync`.
  [[nodiscard]] SurveyedMap surveyed() const { return {map(), sensor(), platform(), reachable(), survey_, tried_}; }
  /// Casts the rays of the sensor through the map of the last `sync`. The first call after a `sync` updates it, which
  /// has a cost; later calls may come from several threads.
  [[nodiscard]] const FollowingCaster& looking() const;
  /// Path lengths through the reachable space, on blocks of cells. The first call after a `sync` updates them.
  [[nodiscard]] const detail::BlockWays& ways() const;
  /// A route of cells through the reachable space from its start to `goal`, both included. Empty if there is none. It
  /// is the shortest one up to 300 cells. Beyond, a route over blocks is found first, and the shortest route of cells
  /// is taken between every eighth of its blocks. So the cost grows with the route, not with the space around it.
  [[nodiscard]] std::vector<VoxelIndex> way_to(const VoxelIndex& goal) const;
  /// A path to a view along the reachable cells of `way`, or along the shortest route if it is empty; if the platform
  /// cannot follow it, by the platform's own path search. None if there is none.
  [[nodiscard]] std::optional<std::vector<Pose>> path_to(const Pose& view,
                                                         std::span<const VoxelIndex> way = {}) const;
  /// A plan that contains the counts of the survey and no choice.
  [[nodiscard]] Plan open_plan() const;

 private:
  void note_what_was_in_vain();
  void find_targets();
  void set_refused_aside();
  [[nodiscard]] double body_m() const;
  [[nodiscard]] bool hardly_moves() const;
  [[nodiscard]] bool stands_beside_unknown() const;
  [[nodiscard]] std::optional<Plan> turn_on_the_spot();
  [[nodiscard]] std::optional<Plan> step_aside();
  [[nodiscard]] std::optional<Plan> look_closely();
  [[nodiscard]] std::optional<Plan> look_at_contested();
  [[nodiscard]] std::optional<OccupancyMap> map_without_contested() const;
  [[nodiscard]] std::vector<VoxelIndex> contested_on_way(const OccupancyMap& open, const ReachableSpace& space,
                                                         const VoxelIndex& goal) const;
  [[nodiscard]] std::optional<Plan> look_again_at(const VoxelIndex& cell) const;
  [[nodiscard]] std::optional<VoxelIndex> place_cut_off() const;
  [[nodiscard]] std::vector<VoxelIndex> out_of_reach(std::vector<VoxelIndex> places, double metres) const;
  [[nodiscard]] std::optional<VoxelIndex> viewpoint_among(std::vector<VoxelIndex> places) const;

  PlannerSetup setup_;
  FrontierSurveyOptions options_;
  const OccupancyMap* map_ = nullptr;
  Pose current_ = Pose::Identity();
  Following<FrontierTracker> frontier_;
  std::vector<VoxelIndex> frontier_cells_;  // of the last sync
  TriedViews tried_;
  FrontierSurveyor surveyor_;
  FrontierSurvey survey_;
  std::vector<VoxelIndex> without_way_;    // places of dropped views
  std::size_t places_left_ = 0;            // that may be put to rest in this plan
  std::vector<FrontierTarget> set_aside_;  // of the survey: from here, goals in their directions failed
  bool is_stuck_ = false;
  mutable FollowingCaster looking_;
  mutable bool looking_follows_ = false;             // whether looking_ is up to date with the map of the last sync
  mutable std::shared_ptr<detail::BlockWays> ways_;  // shared, because the type is incomplete here
  mutable bool ways_follow_ = false;
  double sync_ms_ = 0.0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/situation.ipp>
#include <vantage/planner/impl/situation_contested.ipp>
#include <vantage/planner/impl/situation_end.ipp>
#endif
