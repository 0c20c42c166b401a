// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/view/goal_result.hpp>
#include <vantage/view/leftover.hpp>
#include <vantage/view/view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What the host should do after a call of `plan`.
enum class Outcome : std::uint8_t {
  Move,      ///< there is a view to take: follow the path
  Explored,  ///< nothing is left that this sensor on this platform could observe
  /// Everything within reach is seen, but known free space from which more could be seen is cut off, or the body has
  /// no room to look there: plan again later
  Unreachable,
  Blocked,  ///< the platform cannot start or move, or the strategy has no view with a path; `reason` names the remedy
};

[[nodiscard]] constexpr std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::Move:
      return "move";
    case Outcome::Explored:
      return "explored";
    case Outcome::Unreachable:
      return "unreachable";
    case Outcome::Blocked:
      break;
  }
  return "blocked";
}

/// Counts and times of one plan. Times are for reports only; no decision depends on them.
struct PlanStatistics {
  std::size_t frontier_cells = 0;    ///< all frontier cells in the region, reachable or not
  std::size_t observable_cells = 0;  ///< those of them that some reachable pose can observe
  std::size_t reachable_cells = 0;   ///< cells to which the platform can bring the sensor
  std::size_t void_cells = 0;        ///< void cells; 0 unless the planner searches voids
  std::size_t views_scored = 0;      ///< candidate views evaluated
  std::uint64_t ray_operations = 0;  ///< cells visited along rays, plus cell updates of a field
  std::size_t solver_sweeps = 0;     ///< sweeps of the solver; 0 unless the planner solves a field
  double survey_ms = 0.0;            ///< milliseconds: frontier, reachability, observability
  double evaluate_ms = 0.0;          ///< milliseconds: visibility of candidate views, if timed separately
  double choose_ms = 0.0;            ///< milliseconds: choice of the view
  double path_ms = 0.0;              ///< milliseconds: path to the view

  /// Adds the counts and times of another part of the same plan.
  constexpr PlanStatistics& operator+=(const PlanStatistics& part) {
    frontier_cells += part.frontier_cells;
    observable_cells += part.observable_cells;
    reachable_cells += part.reachable_cells;
    void_cells += part.void_cells;
    views_scored += part.views_scored;
    ray_operations += part.ray_operations;
    solver_sweeps += part.solver_sweeps;
    survey_ms += part.survey_ms;
    evaluate_ms += part.evaluate_ms;
    choose_ms += part.choose_ms;
    path_ms += part.path_ms;
    return *this;
  }
};

/// The result of a call of `plan`: where the sensor should look next.
struct Plan {
  Outcome outcome = Outcome::Blocked;  ///< what the host should do
  View goal;                           ///< the view to take; valid only if outcome is Move
  std::vector<Pose> path;  ///< from the current pose to goal.pose, both included; empty unless outcome is Move
  /// The unknown cells that the view is to resolve; a cell appears once for each target frontier cell beside it. Or
  /// contested cells, at which it looks again. Once all of them are known and none is contested, the rest of the path
  /// is not worth following: plan again. Empty if the planner does not know them.
  std::vector<VoxelIndex> sought;
  /// The views that were compared, with their utilities, for display. Includes the goal of a Move. Empty for planners
  /// that do not compare views.
  std::vector<View> candidates;
  Leftover leftover;                             ///< frontier cells that no view is planned for
  std::string reason = "plan() was not called";  ///< one sentence for a person
  PlanStatistics statistics;                     ///< counts and times of this plan
};

/// Interface of all planners: decides once per cycle where the sensor should look next.
///
///     for (;;) {
///       map.insert(scan);                               // host: scan at the current pose
///       Plan plan = planner->plan(map, current);
///       if (plan.outcome != Outcome::Move) break;
///       follow(plan.path);                              // host: scan on the way, see `check`
///     }
///
/// All planners keep this contract, and one test suite checks it (tests/contract):
/// - The path starts at `current`, ends at `goal.pose` and stays in cells that the platform admits.
/// - Explored means that nothing is left that the sensor could observe and has not looked at in vain.
/// - The same map, pose and seed give the same plan for any number of threads.
/// - Planning twice without a new scan gives the same plan.
/// - A goal to which the robot comes no nearer is given up (TriedViews).
/// - A planner keeps only what it can rebuild from the map, and the memory of tried views, which belongs to one map
///   and can be saved with it.
///
/// ObjectPlanner differs: it remembers only goals that were not reached, and it ends by its own rule.
class ExplorationPlanner {
 public:
  virtual ~ExplorationPlanner() = default;
  /// The name that `make_planner` accepts.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Makes a plan. `current` is the sensor's pose (world_from_sensor) at the last scan; rotation errors of up to 1e-3
  /// are corrected. A pose that the platform does not admit, or that lies outside the region, gives a plan, too.
  /// Throws std::invalid_argument if the pose is not finite or not a rigid transform.
  [[nodiscard]] virtual Plan plan(const OccupancyMap& map, const Pose& current) = 0;
  /// Reports how following the last plan ended. Optional: without it, a goal counts as reached if `current` of the
  /// next plan lies within the tolerances of PlannerSetup, and as failed if the robot came no nearer to it while the
  /// map has changed twice.
  virtual void report(const OccupancyMap& map, const Pose& current, GoalResult result);
  /// What the planner remembers of tried views, as text, to be saved beside the map. Empty if it remembers nothing.
  [[nodiscard]] virtual std::string memory() const;
  /// Restores a text of `memory()` that belongs to this map, so that after a restart the robot does not look again
  /// at what it looked at in vain. Throws std::runtime_error if the text is no memory, or is of cells of another
  /// size. Otherwise the caller must ensure that the text belongs to the map.
  virtual void recall(const OccupancyMap& map, std::string_view memory);
};

}  // namespace vantage
