// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/evaluation/run_figures.hpp>
#include <vantage/report/run_record.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// One run among those that are compared.
struct EvaluatedRun {
  std::string world;                              ///< its name in the tables; implies the sensor and the robot
  std::string planner;                            ///< with its settings: NAME[,KEY=VALUE]...
  std::uint64_t start = 1;                        ///< number of the start, the same for every planner
  RunFigures figures = {};                        ///< figures from the report of the run
  std::optional<PathBound> bound = std::nullopt;  ///< lower bound on the path from this start; none: not computed
};

/// Worlds that share a table.
struct WorldClass {
  std::string name = {};                 ///< heading
  std::string about = {};                ///< one sentence on sensor, robot and cell size
  std::string command = {};              ///< the command line that prints the table
  std::vector<std::string> worlds = {};  ///< names, in the order of the rows
};

/// Tables in Markdown, one for each class of which there are runs: a row for each planner in each world, both in the
/// order in which they first come. Figures are medians, with quartiles behind them where there are several starts;
/// collisions are sums; the times of plans are quantiles over all plans of a row. A column without any figure is left
/// out. "never": less than half of the runs reached that share of the world.
[[nodiscard]] std::string exploration_tables(std::span<const WorldClass> classes, std::span<const EvaluatedRun> runs);

/// The figures of `exploration_tables` and the curves of the runs as JSON, for scripts and for write_evaluation_html:
///   {"classes": [{name, about, command, worlds}], "columns": [{key, title, digits}],
///    "rows": [{world, planner, runs, outcomes, collisions, bounds_met, plan_p50_ms, plan_p99_ms,
///              KEY: {median, q1, q3} | null}],
///    "runs": [{world, planner, start, outcome, curve: [[metres, seconds | null, share], ...]}]}
/// A figure that was not measured, or a quantile that was never reached, is null. A curve has at most 250 points.
[[nodiscard]] std::string exploration_json(std::span<const WorldClass> classes, std::span<const EvaluatedRun> runs);

}  // namespace vantage
