// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/report/run_record.hpp>
#include <vantage/report/run_recorder.hpp>

namespace vantage::apps {

/// Stands before a planner, keeps its last plan, and writes a run that it drives into a folder as it goes. Without a
/// folder it only stands there.
class RunRecording final : public ExplorationPlanner {
 public:
  /// `planner` must outlive it. Nothing is written before the first view.
  RunRecording(ExplorationPlanner& planner, std::filesystem::path folder, RunRecorderSetup setup);

  [[nodiscard]] std::string_view name() const override { return planner_.name(); }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) override;
  void report(const OccupancyMap& map, const Pose& current, GoalResult result) override {
    planner_.report(map, current, result);
  }

  /// After each view, with the map then. Throws std::runtime_error naming what cannot be written.
  void look(const ViewRecord& view, const OccupancyMap& map);
  /// At the end of the run, before its page can be written.
  void finish(const RunRecord& run);
  /// The file, once the first view is in it.
  [[nodiscard]] std::optional<std::filesystem::path> file() const;
  /// What recording took, beside inserting and planning, as a line of the run's summary; empty where nothing was.
  [[nodiscard]] std::string cost(const RunRecord& run) const;

 private:
  ExplorationPlanner& planner_;
  std::filesystem::path folder_;
  RunRecorderSetup setup_;
  std::optional<RunRecorder> recorder_;
  std::optional<Plan> plan_;  // since the view before
  double milliseconds_ = 0.0;
};

}  // namespace vantage::apps
