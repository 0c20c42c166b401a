// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Path, time and coverage after one scan of a run.
struct KnownSoFar {
  std::size_t view = 0;           ///< number of the scan, from 1
  double path_m = 0.0;            ///< path of the sensor so far, metres
  std::optional<double> time_s;   ///< seconds since the first scan; none if the run is not timed
  std::optional<double> covered;  ///< share, in [0, 1]; see RunFigures::covered
};

/// The figures of a run that tables and curves show.
struct RunFigures {
  std::string command;                  ///< "explore", "reconstruct", ...
  std::string world;                    ///< name or file
  std::string planner;                  ///< NAME (make_planner)
  std::uint64_t seed = 1;               ///< seed of everything random in the run
  double resolution_m = 0.0;            ///< edge of a cell of the map, metres
  std::string outcome;                  ///< "explored", "unreachable", "blocked", "budget" or "interrupted"
  std::size_t views = 0;                ///< integrated scans
  double path_m = 0.0;                  ///< path of the sensor, metres
  double turned_deg = 0.0;              ///< total turn of the sensor, degrees
  std::optional<double> duration_s;     ///< RunRecord::duration_s
  std::optional<double> covered;        ///< share at the end, in [0, 1]: RunRecord::seen_coverage, else coverage
  std::size_t collisions = 0;           ///< motions in which the body touched a true surface
  double computing_s = 0.0;             ///< time of inserting and planning, seconds
  std::vector<double> plan_ms;          ///< time of each plan, milliseconds
  std::vector<KnownSoFar> after_views;  ///< one per scan
};

/// Reads the figures from the report of a run (report_json). Throws std::invalid_argument if the text is no report.
[[nodiscard]] RunFigures run_figures(std::string_view report);

/// The first view after which at least this share was known; none if it never was.
[[nodiscard]] std::optional<KnownSoFar> first_known(const RunFigures& run, double share);

}  // namespace vantage
