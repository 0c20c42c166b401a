// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vantage/evaluation/run_figures.hpp>
#include <vantage/report/run_record.hpp>
#include <vector>

#include "apps/evaluation_worlds.hpp"

// The runs of an evaluation and their files.
namespace vantage::apps {

/// A planner with its settings: NAME[,KEY=VALUE]...
using PlannerText = std::string;

/// All planners from one start in one world.
struct EvaluationStart {
  const EvaluationWorld* world = nullptr;
  std::uint64_t start = 1;
};

/// A run that lies in the folder of the results.
struct StoredRun {
  RunFigures figures;
  double wall_s = 0.0;  ///< what it took, from the search for observable cells on
};

/// The folder of an evaluation: a file for each run, written whole, so that what is there need not be run again.
class EvaluationFolder {
 public:
  /// `folder` exists.
  explicit EvaluationFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Options of `vantage explore` for the run of a planner.
  [[nodiscard]] static std::string options_of_run(const EvaluationStart& at, const PlannerText& planner);
  /// None if the run was not made yet, or with other options.
  [[nodiscard]] std::optional<StoredRun> run(const EvaluationStart& at, const PlannerText& planner) const;
  /// Writes the report of a run, with its options and its time before it. Throws std::runtime_error with the path.
  void keep(const EvaluationStart& at, const PlannerText& planner, const RunRecord& record, double wall_s) const;
  /// None if it was not computed yet.
  [[nodiscard]] std::optional<PathBound> bound(const EvaluationStart& at) const;
  void keep(const EvaluationStart& at, const PathBound& bound) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const EvaluationStart& at, const std::string& name) const;

  std::filesystem::path folder_;
};

/// What is told while runs are made. Each is called from the thread of the run.
struct EvaluationObserver {
  std::function<void(const PlannerText&, const ViewRecord&)> on_view;
  std::function<void(const PlannerText&, const StoredRun&)> on_run;
  std::function<void(const PlannerText&, const std::string& message)> on_failure;
  std::function<void(const std::string& doing)> on_work;  ///< besides the runs: looking for observable cells, bounds
  std::function<bool()> stop;                             ///< true: the run is not kept, and nothing more is made
};

/// Makes and keeps the runs of these planners, and the bound if the world has one and it is not there. What a planner
/// or a world throws is told as a failure; what cannot be written is thrown.
void make_runs(const EvaluationFolder& folder, const EvaluationStart& at, const std::vector<PlannerText>& planners,
               int threads, const EvaluationObserver& observer);

/// Options of `vantage explore` that choose a planner. Throws std::invalid_argument if a setting is no KEY=VALUE.
[[nodiscard]] std::string planner_options(const PlannerText& planner);

}  // namespace vantage::apps
