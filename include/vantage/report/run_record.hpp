// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a whole run ended: as the planner said, or because the budget of views was spent or somebody stopped it.
enum class RunOutcome : std::uint8_t { Explored, Unreachable, Blocked, Budget, Interrupted };

/// The outcome of a run that ended with this outcome of the planner. Move gives Budget: the planner was not done.
[[nodiscard]] constexpr RunOutcome run_outcome_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::Explored:
      return RunOutcome::Explored;
    case Outcome::Unreachable:
      return RunOutcome::Unreachable;
    case Outcome::Blocked:
      return RunOutcome::Blocked;
    case Outcome::Move:
      break;
  }
  return RunOutcome::Budget;
}

[[nodiscard]] constexpr std::string_view to_string(RunOutcome outcome) {
  switch (outcome) {
    case RunOutcome::Explored:
      return "explored";
    case RunOutcome::Unreachable:
      return "unreachable";
    case RunOutcome::Blocked:
      return "blocked";
    case RunOutcome::Interrupted:
      return "interrupted";
    case RunOutcome::Budget:
      break;
  }
  return "budget";
}

/// One integrated scan of a run and what was known after it.
struct ViewRecord {
  std::size_t view = 0;          ///< number of the scan, from 1
  Pose pose = Pose::Identity();  ///< world_from_sensor of the scan
  /// Share of the observable cells that the map knows with the right state, in [0, 1]; none without ground truth.
  std::optional<double> coverage;
  /// Share of the surface samples of an object with a measured point near them; none without an object.
  std::optional<double> surface_coverage;
  /// Share of the surface samples of an object that an image has shown (SeenSurface); none without an object.
  std::optional<double> seen_coverage;
  double path_length_m = 0.0;       ///< path of the sensor so far, metres
  std::optional<double> time_s;     ///< seconds since the first scan; none if the run is not timed
  double insert_ms = 0.0;           ///< time to integrate the scan, milliseconds
  double plan_ms = 0.0;             ///< time of the plan, milliseconds; 0 if the previous plan was still followed
  double utility = 0.0;             ///< utility of the goal chosen after this scan, in the unit of the planner
  std::size_t frontier_cells = 0;   ///< after this scan; the last count if no plan was made
  std::size_t void_cells = 0;       ///< after this scan; only planners that look for voids count them
  Outcome outcome = Outcome::Move;  ///< outcome of the plan made after this scan
  /// Sensor positions since the previous scan, world frame, metres; the last is that of this scan. May be empty if
  /// the sensor has not moved.
  std::vector<Eigen::Vector3d> passed = {};
};

/// A lower bound on the path of a run that sees everything, under the rules of watchman_route and watchman_bound.
struct PathBound {
  double length_m = 0.0;  ///< metres; no route over cells from the start that sees everything is shorter
  bool is_met = false;    ///< whether a path of this length is known
};

/// Result of the brute-force check at the end of a run; see `audit` (sim/audit.hpp).
struct AuditRecord {
  std::size_t cells_checked = 0;      ///< unknown cells beside free ones
  std::size_t looked_at_in_vain = 0;  ///< observable ones that were in view from different cells and stayed unknown
  std::size_t observable_left = 0;    ///< the other observable ones; 0 for a run that explored everything
};

/// The record of a run of any host: what reports, pictures and tables need.
struct RunRecord {
  std::string command;                      ///< "explore", "reconstruct", "search", "replay"
  std::string world;                        ///< name or file of the world
  std::string planner;                      ///< its NAME (make_planner)
  std::uint64_t seed = 1;                   ///< seed of everything random in the run
  int threads = 1;                          ///< threads given to the planner
  double resolution_m = 0.0;                ///< edge of a cell of the map, metres
  RunOutcome outcome = RunOutcome::Budget;  ///< how the run ended
  std::string reason;                       ///< one sentence, for a person
  std::optional<double> coverage;           ///< at the end; see ViewRecord::coverage
  std::size_t observable_cells = 0;         ///< cells that the sensor could see at all, by the truth; 0: not known
  std::optional<double> surface_coverage;   ///< at the end; see ViewRecord::surface_coverage
  std::optional<double> seen_coverage;      ///< at the end; see ViewRecord::seen_coverage
  /// Samples seen, as a share of those that any admitted pose could see; none without an object.
  std::optional<double> seen_observable;
  /// Time of the last scan that made known a cell that the plan then sought (any cell, if the plan sought none in
  /// particular), seconds. None if the run is not timed.
  std::optional<double> duration_s;
  double turned_deg = 0.0;                   ///< total turn of the sensor, degrees; only runs of ExplorationRun
  Leftover leftover;                         ///< frontier cells that no view was planned for at the end, by cause
  std::size_t collisions = 0;                ///< motions in which the body touched a true surface
  std::uint64_t integration_operations = 0;  ///< cells updated by all scans
  std::uint64_t planning_operations = 0;     ///< sum of PlanStatistics::ray_operations
  /// Updates of cells that the map refused because it was full (OccupancyMap::cells_refused). If there are any, a run
  /// whose planner found nothing left ends as Budget, because not all that was seen could be stored.
  std::size_t cells_refused = 0;
  double peak_memory_mb = 0.0;             ///< peak memory of the whole process, MiB
  std::optional<PathBound> path_bound;     ///< lower bound with full knowledge of the world; none if not asked for
  std::optional<AuditRecord> audit;        ///< result of `audit` on the last map; none if not asked for
  std::vector<ViewRecord> views;           ///< one per integrated scan, in order
  std::vector<Eigen::Vector3d> travelled;  ///< successive sensor positions, the start first; world frame, metres

  /// Length of the whole path, metres; 0 without a scan.
  [[nodiscard]] double path_length_m() const { return views.empty() ? 0.0 : views.back().path_length_m; }
};

}  // namespace vantage
