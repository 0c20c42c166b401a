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

/// How a whole run ended.
enum class RunOutcome : std::uint8_t { Explored, Unreachable, Blocked, Budget, Interrupted };

/// What the outcome of a planner that is done makes of the run; Budget for Move.
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
  std::size_t view = 0;                    ///< 1 for the first scan
  Pose pose = Pose::Identity();            ///< world_from_sensor of the scan
  std::optional<double> coverage;          ///< after this scan, where the true world is known
  std::optional<double> surface_coverage;  ///< after this scan, where an object was to be seen: measured within a gap
  std::optional<double> seen_coverage;     ///< the same: share of its surface that was in an image (SeenSurface)
  double path_length_m = 0.0;              ///< travelled so far
  double insert_ms = 0.0;                  ///< time to integrate the scan
  double plan_ms = 0.0;                    ///< 0 where the plan before was still being followed
  double utility = 0.0;                    ///< of the goal chosen after this scan
  std::size_t frontier_cells = 0;          ///< after this scan; as last counted where no plan was made
  std::size_t void_cells = 0;              ///< after this scan; planners that look for voids
  Outcome outcome = Outcome::Move;         ///< of the plan made after this scan
  /// Successive sensor positions since the scan before, this scan's the last; may be empty where nothing has moved.
  std::vector<Eigen::Vector3d> passed = {};
};

/// What is proven of the way that a run has to go.
struct PathBound {
  double length_m = 0.0;  ///< no way from the start that sees everything is shorter
  bool is_met = false;    ///< there is one that long
};

/// What a check of the end of a run by brute force found (sim's `audit`, which has the words).
struct AuditRecord {
  std::size_t cells_checked = 0;      ///< unknown cells beside free ones
  std::size_t looked_at_in_vain = 0;  ///< of these, in view of the run from places that differ, and still unknown
  std::size_t observable_left = 0;    ///< of these, the others that could still be observed
};

/// The record of a run, by whatever host: enough for the report, the pictures and the tables.
struct RunRecord {
  std::string command;                       ///< "explore", "reconstruct", "search", "replay"
  std::string world;                         ///< name or file
  std::string planner;                       ///< by its NAME
  std::uint64_t seed = 1;                    ///< of everything random in the run
  int threads = 1;                           ///< the planner was given
  double resolution_m = 0.0;                 ///< edge of a cell of the map
  RunOutcome outcome = RunOutcome::Budget;   ///< how the run ended
  std::string reason;                        ///< one sentence, for a person
  std::optional<double> coverage;            ///< at the end, where the true world is known
  std::size_t observable_cells = 0;          ///< cells the sensor could ever see there, by the truth
  std::optional<double> surface_coverage;    ///< at the end, where an object was to be seen: measured within a gap
  std::optional<double> seen_coverage;       ///< the same: share of its surface that was in an image
  std::optional<double> seen_observable;     ///< the same, of what any admitted pose could see
  Leftover leftover;                         ///< frontier or void cells given up
  std::size_t collisions = 0;                ///< of the body with the true world
  std::uint64_t integration_operations = 0;  ///< cell updates by scans
  std::uint64_t planning_operations = 0;     ///< PlanStatistics::ray_operations, summed
  double peak_memory_mb = 0.0;               ///< of the whole process
  std::optional<PathBound> path_bound;       ///< for one who knows the world, where it was sought
  std::optional<AuditRecord> audit;          ///< of the end, where it was asked for
  std::vector<ViewRecord> views;             ///< one entry per scan
  std::vector<Eigen::Vector3d> travelled;    ///< successive sensor positions, the start first

  /// Travelled in all, metres.
  [[nodiscard]] double path_length_m() const { return views.empty() ? 0.0 : views.back().path_length_m; }
};

}  // namespace vantage
