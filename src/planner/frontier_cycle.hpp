// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vantage/planner/frontier_surveyor.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/target_view.hpp>
#include <vector>

namespace vantage::detail {

/// Milliseconds since it was made or last read.
class Stopwatch {
 public:
  [[nodiscard]] double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What all planners that go for frontiers do around their strategy: survey the map, know when it is over, and turn a
/// chosen view into a plan.
class FrontierCycle {
 public:
  /// Surveys; throws std::invalid_argument if `current` is not a pose in the map. `failed` outlives the cycle;
  /// `surveyor` has the platform and the sensor of `setup`. Whoever knows the frontier cells of the map already hands
  /// them over.
  FrontierCycle(const OccupancyMap& map, const Pose& current, const PlannerSetup& setup, FrontierSurveyor& surveyor,
                FailedViews& failed, std::optional<std::vector<VoxelIndex>> frontier = std::nullopt);

  [[nodiscard]] const FrontierSurvey& survey() const { return survey_; }
  [[nodiscard]] Plan& plan() { return plan_; }
  /// The plan that ends the run, if there is nothing to choose from.
  [[nodiscard]] bool over() const { return over_; }
  /// The plan that goes to `chosen` by `way`, cells from the start of the reachable space to the view's cell; Blocked
  /// if the platform cannot follow it.
  [[nodiscard]] Plan go(TargetView chosen, std::span<const VoxelIndex> way);
  /// Likewise by poses already joined by admitted motions, from `current` to the view's pose.
  [[nodiscard]] Plan go(TargetView chosen, std::vector<Pose> path);
  [[nodiscard]] Plan blocked(std::string reason);

 private:
  const OccupancyMap& map_;
  const Pose& current_;
  const PlannerSetup& setup_;
  FailedViews& failed_;
  Stopwatch stopwatch_;
  FrontierSurvey survey_;
  Plan plan_;
  bool over_ = false;
};

/// Throws std::invalid_argument unless `current` is a pose in the map.
void validate(const OccupancyMap& map, const Pose& current);
/// Throws std::invalid_argument if the setup lacks a platform, or its sensor or thread count is not valid.
void validate(const PlannerSetup& setup);
/// Throws std::invalid_argument naming the option at fault.
void validate(const FrontierSurveyOptions& options);

}  // namespace vantage::detail
