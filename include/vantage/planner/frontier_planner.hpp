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

/// What a strategy chooses: a view and the path to it; or none, and why.
struct Choice {
  std::optional<TargetView> view = {};  ///< the view and the cells that it is to resolve; none: no view serves
  /// The path as poses joined by admitted motions, from the current pose to the pose of the view. Empty: `way` is
  /// used.
  std::vector<Pose> path = {};
  /// The path as reachable cells, from the start of the reachable space to the cell of the view. Empty: the shortest.
  std::vector<VoxelIndex> way = {};
  /// One sentence for a person. Empty: a default one with the number of unknown cells to resolve.
  std::string reason = {};
  std::vector<View> candidates = {};  ///< the views that were compared, with their utilities, for display
  PlanStatistics statistics = {};     ///< counts of the choice; the planner adds them to those of the plan
};

/// A view of the target with the shortest route, and that route. Its statistics are `so_far` and its own. Requires a
/// target.
[[nodiscard]] Choice nearest_view(const Situation& situation, const PlanStatistics& so_far = {});

/// Base class of planners that look at frontiers. It contains everything but the choice: it updates the Situation,
/// ends the run if no target is left, and makes a plan of the chosen view. A new strategy overrides `choose`.
///
///     class MyPlanner final : public FrontierPlanner {
///       Choice choose(const Situation& situation) override { ... situation.survey().targets ... }
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
  /// Called once the situation is up to date, before the first `choose` or the end of the run, and again whenever
  /// places were put to rest: discards results of the last plan. Returns counts that every plan has.
  virtual PlanStatistics prepare(const Situation& /*situation*/) { return {}; }
  /// Chooses a view. At least one target exists. If no view serves, the plan is Blocked for the reason of the choice.
  /// If no path leads to the chosen view, the targets that it sees are removed for this plan and `choose` is called
  /// again. When none is left, their places rest, and targets that are seen from elsewhere follow.
  [[nodiscard]] virtual Choice choose(const Situation& situation) = 0;
  /// What a utility is worth at the end of a way of `way_m` metres: at a price of `cost_per_m`, in 1/m, >= 0.
  [[nodiscard]] static double worth(double utility, double cost_per_m, double way_m);

 private:
  [[nodiscard]] Plan plan_of_choice(std::vector<VoxelIndex>& hoped, PlanStatistics& spent);

  Situation situation_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/frontier_planner.ipp>
#endif
