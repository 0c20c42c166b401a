// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What the host is to do after a call of `plan`.
enum class Outcome : std::uint8_t {
  Move,         ///< there is a view to take: follow the path
  Explored,     ///< nothing that this sensor on this platform could observe is left
  Unreachable,  ///< all that can be reached is seen, but known free space with more to see is cut off: ask again
                ///< later
  Blocked,      ///< the platform cannot start or move; `reason` holds the remedy
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

/// How following a plan ended, as the host knows it.
enum class GoalResult : std::uint8_t {
  Reached,    ///< the sensor is as near to the goal as the controller brings it, and has scanned there
  Failed,     ///< the controller cannot get there
  Preempted,  ///< the host has other plans; says nothing about the goal
};

/// Frontier cells that no view is planned for, by cause.
struct Leftover {
  std::size_t unreachable = 0;   ///< not beside any place that the platform can reach
  std::size_t unobservable = 0;  ///< no reachable pose of this sensor has a line of sight to what lies behind them
  std::size_t in_vain = 0;       ///< looked at from places that differ, and nothing was learned (TriedViews)

  /// The same counts.
  friend bool operator==(const Leftover&, const Leftover&) = default;
};

/// Where to look, and what the planner expects of it.
struct View {
  Pose pose = Pose::Identity();  ///< world_from_sensor
  double utility = 0.0;          ///< in the planner's own unit; 0 where there is nothing to expect
};

/// Counts and times of one cycle. Times are for reports only; nothing depends on them.
struct PlanStatistics {
  std::size_t frontier_cells = 0;    ///< inside the region, reachable or not
  std::size_t observable_cells = 0;  ///< of those, the ones some reachable pose can resolve
  std::size_t reachable_cells = 0;   ///< cells the platform can bring the sensor to
  std::size_t void_cells = 0;        ///< planners that look for voids
  std::size_t views_scored = 0;      ///< candidate views evaluated
  std::uint64_t ray_operations = 0;  ///< cells visited along rays, plus cell updates of a field
  std::size_t solver_sweeps = 0;     ///< planners that solve a field
  double survey_ms = 0.0;            ///< frontiers, reachability, observability
  double evaluate_ms = 0.0;          ///< what candidate views would see; planners that evaluate them
  double choose_ms = 0.0;            ///< the strategy itself
  double path_ms = 0.0;              ///< the way there
};

/// The answer to "where should the sensor look next?".
struct Plan {
  Outcome outcome = Outcome::Blocked;  ///< what to do now
  View goal;                           ///< the view to take; meaningful if outcome is Move
  std::vector<Pose> path;  ///< from the current pose to goal.pose, both included; empty unless outcome is Move
  /// The unknown cells that the view is to resolve, once for every frontier cell beside them. Once scans on the way
  /// have made all of them known, the rest of the way is not worth following: plan again. Empty if the planner cannot
  /// say.
  std::vector<VoxelIndex> sought;
  /// The views that were weighed against the goal, itself included, with their utilities; for whoever wants to look.
  /// Empty for planners that weigh none.
  std::vector<View> candidates;
  Leftover leftover;                             ///< what no view is planned for
  std::string reason = "plan() was not called";  ///< one sentence, for a person
  PlanStatistics statistics;                     ///< what it took
};

/// Answers once per cycle where to look next. A host's whole loop: `map.insert(scan)`, `planner->plan(map, pose)`,
/// follow the path, repeat.
///
/// Every planner keeps this contract, and one test suite holds all of them to it: the path starts at `current`, ends
/// at `goal.pose` and stays in known-free cells that the platform admits; the outcome is Explored only when nothing
/// is left that the sensor could observe and has not looked at in vain; the same map, pose and seed give the same
/// plan for any number of threads; planning twice without a new scan changes nothing; a goal that the robot does not
/// come nearer to is not asked for again and again; and but for the memory of views that were tried, which belongs to
/// one map, a planner holds nothing that the map cannot rebuild.
class ExplorationPlanner {
 public:
  virtual ~ExplorationPlanner() = default;
  /// The NAME that `make_planner` knows it by.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// `current` is the sensor's pose at the last scan; a rotation that is off by up to 1e-3 is made orthonormal. A
  /// pose that the platform does not admit, or outside of the region, gives a plan as well. Throws
  /// std::invalid_argument if a number of the pose is not finite or it is no rigid transform.
  [[nodiscard]] virtual Plan plan(const OccupancyMap& map, const Pose& current) = 0;
  /// Tells how following the last plan ended. Optional: without it a goal counts as reached when `current` of the
  /// next plan is within PlannerSetup's tolerances of it, and as failed when the robot came no nearer to it while the
  /// map has grown twice.
  virtual void report(const OccupancyMap& map, const Pose& current, GoalResult result);
};

}  // namespace vantage
