// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/situation.hpp>
#include <vantage/planner/target_view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a strategy chose: a view and the way there.
struct ChosenView {
  TargetView view;  ///< the view and what it is to resolve
  /// The way, as reachable cells from the start of the reachable space to the view's place ...
  std::vector<VoxelIndex> way = {};
  /// ... or, if not empty, as poses joined by admitted motions, from the current pose to the view's.
  std::vector<Pose> path = {};
  /// One sentence, for a person; empty: how many unknown cells the view is to resolve.
  std::string reason = {};
};

/// A planner that goes for frontiers: all but the choice. It brings the situation up to date, ends the run where
/// there is nothing to choose from, and turns a chosen view into a plan.
///
///     class MyPlanner final : public FrontierPlanner {
///       std::optional<ChosenView> choose(Plan& plan) override { ... situation().survey().targets ... }
///     };
class FrontierPlanner : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument naming the part of the setup or the option at fault.
  explicit FrontierPlanner(const PlannerSetup& setup, const FrontierSurveyOptions& options = {})
      : situation_(setup, options) {}

  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) final;
  void report(const OccupancyMap& map, const Pose& current, GoalResult result) final;

 protected:
  /// What the plan is made from; up to date in `prepare` and `choose`.
  [[nodiscard]] const Situation& situation() const { return situation_; }
  /// Called once per plan, before anything else: forgets what the last plan has left behind.
  virtual void prepare(Plan& /*plan*/) {}
  /// Chooses; there is at least one target. May fill in the plan's candidates, statistics and reason. None if no view
  /// serves: then the plan's reason says why, and the plan is Blocked. A choice to which there turns out to be no way
  /// is asked for again without the targets seen from there.
  [[nodiscard]] virtual std::optional<ChosenView> choose(Plan& plan) = 0;

 private:
  Situation situation_;
};

}  // namespace vantage
