// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/situation.hpp>
#include <vantage/view/target_view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The choice of a strategy: a view and the path to it.
struct ChosenView {
  TargetView view;  ///< the view and the cells that it is to resolve
  /// The path as poses joined by admitted motions, from the current pose to the pose of the view. Empty: `way` is
  /// used.
  std::vector<Pose> path = {};
  /// The path as reachable cells, from the start of the reachable space to the cell of the view. Empty: the shortest.
  std::vector<VoxelIndex> way = {};
  /// One sentence for a person; empty: a default one with the number of unknown cells to resolve.
  std::string reason = {};
};

/// A view of the target with the shortest route, and that route. Adds the number of visited cells to `operations`.
/// Requires a target.
[[nodiscard]] ChosenView nearest_view(const Situation& situation, std::uint64_t& operations);

/// Base class of planners that look at frontiers. It contains everything but the choice: it updates the Situation,
/// ends the run if no target is left, and makes a plan of the chosen view. A new strategy overrides `choose`.
///
///     class MyPlanner final : public FrontierPlanner {
///       std::optional<ChosenView> choose(Plan& plan) override { ... situation().survey().targets ... }
///     };
class FrontierPlanner : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit FrontierPlanner(const PlannerSetup& setup, const FrontierSurveyOptions& options = {})
      : situation_(setup, options) {}

  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) final;
  void report(const OccupancyMap& /*map*/, const Pose& /*current*/, GoalResult result) final {
    situation_.report(result);
  }
  [[nodiscard]] std::string memory() const final { return situation_.tried().text(); }
  void recall(const OccupancyMap& map, std::string_view memory) final { situation_.recall(map, memory); }

 protected:
  /// The input of the plan. Up to date in `prepare` and `choose`.
  [[nodiscard]] const Situation& situation() const { return situation_; }
  /// Called after the situation is up to date and before `choose`: discards results of the last plan.
  virtual void prepare(Plan& /*plan*/) {}
  /// Chooses a view. At least one target exists. May fill in candidates, statistics and reason of `plan`. Returns
  /// nothing if no view serves: the plan is then Blocked, and `plan.reason` should say why. If no path leads to the
  /// chosen view, the targets that it sees are removed for this plan and `choose` is called again.
  [[nodiscard]] virtual std::optional<ChosenView> choose(Plan& plan) = 0;

 private:
  std::vector<VoxelIndex> take_a_view(Plan& plan);

  Situation situation_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/frontier_planner.ipp>
#endif
