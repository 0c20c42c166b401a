// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vantage/report/run_record.hpp>
#include <vector>

#include "apps/evaluation_runs.hpp"

namespace vantage::apps {

/// The times of the runs that were made, and those still to make, by world.
struct RunsOfWorld {
  std::vector<double> wall_s;
  std::size_t left = 0;
};

/// What the runs left will take in sequence, seconds: as long each as those made took in the same world on average,
/// or, where there are none, in all worlds. 0 if none was made.
[[nodiscard]] double seconds_left(const std::map<std::string_view, RunsOfWorld>& worlds);

/// Tells on stderr how far an evaluation has come: a moving line on a terminal, otherwise a line per run. May be
/// called from several threads.
class EvaluationProgress {
 public:
  /// `jobs` runs are made at a time.
  explicit EvaluationProgress(std::size_t jobs);

  /// A run to make, or one that was made before.
  void expect(const EvaluationStart& at) { ++worlds_[at.world->name].left; }
  void found(const EvaluationStart& at, const StoredRun& run);

  void view(const EvaluationStart& at, const PlannerText& planner, const ViewRecord& view);
  void work(const EvaluationStart& at, const std::string& doing);
  void made(const EvaluationStart& at, const PlannerText& planner, const StoredRun& run);
  void failed(const EvaluationStart& at, const PlannerText& planner, const std::string& message);
  /// Removes the moving line.
  void finish();

 private:
  void move(const std::string& text);
  void say(const std::string& text);
  [[nodiscard]] std::string so_far() const;

  bool terminal_;
  std::size_t jobs_;
  std::map<std::string_view, RunsOfWorld> worlds_;
  std::chrono::steady_clock::time_point moved_;
  std::mutex mutex_;
};

}  // namespace vantage::apps
