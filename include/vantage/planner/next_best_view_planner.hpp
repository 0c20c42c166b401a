// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/planner_setup.hpp>
#include <vantage/view/information_gain.hpp>
#include <vantage/view/object_views.hpp>
#include <vantage/view/object_visibility.hpp>
#include <vantage/view/tried_views.hpp>
#include <vantage/view/view_utility.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Candidate views, thresholds and information gain of NextBestViewPlanner.
struct NextBestViewOptions {
  ObjectViewOptions candidates;  ///< the box of the object and its candidate views
  /// Minimum number of occupied cells of the object that a view must see, `h_oc` in eq. 2. Ignored while no cell of
  /// the object is occupied.
  std::size_t min_overlap_cells = 0;
  /// Minimum number of unknown cells of the object that a view must see, >= 1. If no view does, the object is
  /// finished (VI-B: 50).
  std::size_t min_unknown_cells = 50;

  /// Information gain of a view (eq. 3); none: the number of unknown cells (eq. 4), which also decides if the gain is
  /// 0 for all views. `min_unknown_cells` applies in both cases.
  RayGainMaker gain = nullptr;
  SensingOptions sensing = {};  ///< which of the cells that a view sees the sensor would measure (II-C)

  VisibilityMethod method = VisibilityMethod::Exact;  ///< how the cells that a view sees are counted
  int patience = TriedViewsOptions{}.patience;        ///< TriedViewsOptions::patience
};

/// Next-best-view planning for one object: takes the candidate view of the highest utility `u = pos reg sur dist`
/// (eq. 1-5). By default, the visible cells are counted exactly, as distinct cells (evaluate_view), instead of by the
/// hierarchical approximation of the paper. The run ends when no admitted candidate sees enough unknown cells of the
/// object. NextBestViewExplorer explores a whole map in this way. (Vasquez-Gomez et al. 2013, Algorithm 1.)
class NextBestViewPlanner final : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  NextBestViewPlanner(const PlannerSetup& setup, const NextBestViewOptions& options);

  [[nodiscard]] std::string_view name() const override { return "next-best-view"; }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& pose) override;
  void report(const OccupancyMap& /*map*/, const Pose& /*current*/, GoalResult result) override {
    tried_.report(result);
  }
  [[nodiscard]] std::string memory() const override { return tried_.text(); }
  void recall(const OccupancyMap& map, std::string_view memory) override { tried_.recall(map, memory); }

 private:
  struct Candidate {
    ScoredView view;
    CellSet sought;        // the unknown cells that it would measure and that are not given up
    double counted = 0.0;  // their number, as counted by the chosen VisibilityMethod
  };

  [[nodiscard]] bool draws_views() const;
  [[nodiscard]] std::vector<Pose> views(const OccupancyMap& map, const VoxelBox& object) const;
  [[nodiscard]] std::vector<Candidate> candidates(const OccupancyMap& map, const Pose& current,
                                                  const VoxelBox& object) const;
  [[nodiscard]] std::vector<ScoredView> score(const OccupancyMap& map, const Pose& current, const VoxelBox& object,
                                              std::span<const Pose> views,
                                              const std::vector<ViewEvaluation>& seen) const;
  void take(const OccupancyMap& map, const Pose& current, const ScoredView& view, const CellSet& sought, Plan& plan);

  PlannerSetup setup_;
  NextBestViewOptions options_;
  ObjectViewOptions shells_;  // options_.candidates, with radii
  TriedViews tried_;
  FollowingCaster looking_;  // follows the map of the last plan
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/next_best_view_planner.ipp>
#endif
