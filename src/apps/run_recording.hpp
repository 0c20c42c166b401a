// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/report/run_record.hpp>
#include <vantage/report/run_recorder.hpp>

#include "apps/run_files.hpp"

namespace vantage::apps {

/// A planner that passes every call on to another one, keeps its last plan, and writes the run into a folder.
/// Without a folder it writes nothing.
class RunRecording final : public ExplorationPlanner {
 public:
  /// `planner` must outlive it. Nothing is written before the first view.
  RunRecording(ExplorationPlanner& planner, std::filesystem::path folder, RunRecorderSetup setup);

  [[nodiscard]] std::string_view name() const override { return planner_.name(); }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) override;
  void report(const OccupancyMap& map, const Pose& current, GoalResult result) override {
    planner_.report(map, current, result);
  }

  /// Called after each view with the map at that time. Throws std::runtime_error if there can be no folder. A record
  /// that cannot be written ends with the view before, and the run goes on.
  void look(const ViewRecord& view, const OccupancyMap& map);
  /// Called at the end of the run, before its page is written.
  void finish(const RunRecord& run);
  /// The record file, once it holds the first view.
  [[nodiscard]] std::optional<std::filesystem::path> file() const;
  /// Throws std::runtime_error with the path and the reason if the record could not be written.
  void check() const { errors_.check(); }
  /// A line for the summary: the time of recording beside those of inserting and planning; empty if nothing was
  /// recorded.
  [[nodiscard]] std::string cost(const RunRecord& run) const;

 private:
  ExplorationPlanner& planner_;
  std::filesystem::path folder_;
  RunRecorderSetup setup_;
  std::optional<RunRecorder> recorder_;
  std::optional<Plan> plan_;  // made since the previous view
  OutputFiles errors_;
  bool writable_ = true;
  double milliseconds_ = 0.0;
};

}  // namespace vantage::apps
