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

/// How a cycle of planning ended.
enum class Outcome : std::uint8_t {
  Move,      ///< there is a view to take: follow the path
  Explored,  ///< nothing that this sensor on this platform could observe is left
  Blocked,   ///< something is left, and `reason` says why it cannot be had
};

[[nodiscard]] constexpr std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::Move:
      return "move";
    case Outcome::Explored:
      return "explored";
    case Outcome::Blocked:
      break;
  }
  return "blocked";
}

/// Frontier or void cells given up, by cause.
struct Leftover {
  std::size_t unreachable = 0;   ///< not joined to the sensor through cells the platform admits
  std::size_t unobservable = 0;  ///< no reachable pose of this sensor sees what lies behind them
  std::size_t too_small = 0;     ///< in clusters below the size the options ask for

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
  bool scan_on_the_way =
      true;           ///< false: before the goal none of `sought` is in sight, so a scan there can be spared
  Leftover leftover;  ///< what was given up
  std::string reason = "plan() was not called";  ///< one sentence, for a person
  PlanStatistics statistics;                     ///< what it took
};

/// Answers once per cycle where to look next. A host's whole loop: `map.insert(scan)`, `planner->plan(map, pose)`,
/// follow the path, repeat.
///
/// Every planner keeps this contract, and one test suite holds all of them to it: the path starts at `current`, ends
/// at `goal.pose` and stays in known-free cells that the platform admits; the outcome is Explored exactly when
/// nothing observable is left but what the options leave as too small; the same map, pose and seed give the same plan
/// for any number of threads; planning twice without a new scan changes nothing; and but for the memory of failed
/// goals, which belongs to one map, a planner holds nothing that the map cannot rebuild.
class ExplorationPlanner {
 public:
  virtual ~ExplorationPlanner() = default;
  /// The NAME that `make_planner` knows it by.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// `current` is the sensor's pose now. Throws std::invalid_argument if it is not rigid or not in the map's region.
  [[nodiscard]] virtual Plan plan(const OccupancyMap& map, const Pose& current) = 0;
};

}  // namespace vantage
