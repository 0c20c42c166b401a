// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/planner/tried_views.hpp>
#include <vantage/raytrace/following_caster.hpp>
#include <vantage/view/aimed_views.hpp>
#include <vantage/view/information_gain.hpp>
#include <vantage/view/sensing_constraint.hpp>
#include <vantage/view/view_utility.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a NextBestViewPlanner counts what a view of an object sees.
enum class VisibilityMethod : std::uint8_t {
  Exact,         ///< distinct cells, by evaluate_view
  Uniform,       ///< the same cells, by walking every ray: the paper's method of comparison
  Hierarchical,  ///< rays, by HierarchicalRayTracer: the paper's own
};

/// How a NextBestViewPlanner chooses among the views of an object.
enum class ViewChoice : std::uint8_t {
  Greedy,  ///< the one of the largest utility: the paper's own
  /// Of the few that together see every unknown cell that any sees (cover_views), found anew every cycle, the one of
  /// the largest utility: a view that others make needless is not taken because it is near.
  Cover,
};

/// Options of NextBestViewPlanner.
struct NextBestViewOptions {
  /// The box of the object to reconstruct, metres; none: the whole map is to be seen.
  std::optional<Box> object = std::nullopt;

  // With an object:
  /// Candidates look at the middle of the object from shells this far off, each > 0, at least one (VI-A).
  std::vector<double> radii_m = {1.5};
  /// Those of a shell are 20 * 4^this, evenly spread, in [-1, 6]; the paper's 320 by default. -1: there are none.
  int subdivisions = 2;
  /// As many more, from places drawn in the region or, without one, in the known part of the map (VI-B).
  std::size_t random_candidates = 0;
  /// And these, drawn anew for every map: aimed at unknown cells of the object from where they can be seen.
  AimedViewOptions aimed = {};
  /// The least overlap: how many occupied cells of the object a view must see, `h_oc` in eq. 2. Waived while none is
  /// known.
  std::size_t min_overlap_cells = 0;
  /// A view must see this many unknown cells of the object, >= 1; when none does, the object is done (VI-B: 50).
  std::size_t min_unknown_cells = 50;

  /// What new surface is worth (eq. 3); none: the paper's count of unknown cells (eq. 4). Whatever it is, a view must
  /// see `min_unknown_cells`; where it finds nothing in any view, the count decides.
  RayGainMaker gain = nullptr;
  SensingOptions sensing = {};            ///< which of the cells that a view sees its sensor would measure (II-C)
  ViewChoice choice = ViewChoice::Cover;  ///< which view is taken

  VisibilityMethod method = VisibilityMethod::Exact;  ///< how views are evaluated
  int hierarchical_levels = 3;  ///< HierarchicalRayTracerOptions::levels, in [1, 16] (VI-B: start depth 14 of 16)

  // Without one:
  std::size_t hypotheses =
      100;  ///< poses drawn in the reachable space per plan, every other aimed at a frontier; >= 1

  FrontierSurveyOptions survey = {};  ///< how thoroughly it looks for frontiers, and the patience with failed views
};

/// The next best view of Vasquez-Gomez et al. 2013, Algorithm 1: of many candidate views, the one of the largest
/// utility `u = pos reg sur dist` (eq. 1-5), where what a view would see is counted exactly, in distinct cells
/// (evaluate_view), rather than by their hierarchical approximation.
///
/// With an object box, that object is reconstructed: the run is over when no admitted candidate sees enough unknown
/// cells of it. Without, the map is explored: candidates are drawn where the platform can get, and what is left is
/// judged by the survey that all planners share.
class NextBestViewPlanner final : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument naming the option at fault.
  explicit NextBestViewPlanner(const PlannerSetup& setup, const NextBestViewOptions& options = {});

  /// "next-best-view".
  [[nodiscard]] std::string_view name() const override { return "next-best-view"; }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) override;
  void report(const OccupancyMap& map, const Pose& current, GoalResult result) override {
    tried_.report(result);
    explorer_.report(map, current, result);
  }

 private:
  struct Candidate {
    ScoredView view;
    CellSet sought;        // the unknown cells that it would measure and that are not given up
    double counted = 0.0;  // how many they are by the method asked for
  };

  [[nodiscard]] std::vector<Pose> views_of_object(const OccupancyMap& map, const VoxelBox& object) const;
  [[nodiscard]] std::vector<Candidate> candidates(const OccupancyMap& map, const Pose& current,
                                                  const VoxelBox& object) const;
  [[nodiscard]] std::vector<ScoredView> score(const OccupancyMap& map, const Pose& current, const VoxelBox& object,
                                              std::span<const Pose> views,
                                              const std::vector<ViewEvaluation>& seen) const;
  [[nodiscard]] std::vector<ViewEvaluation> evaluate(const OccupancyMap& map, const VoxelBox& object,
                                                     std::span<const Pose> views, std::span<CellSet> seen) const;
  [[nodiscard]] std::vector<std::size_t> order_of(const std::vector<Candidate>& candidates) const;
  [[nodiscard]] Plan reconstruct(const OccupancyMap& map, const Pose& current);

  PlannerSetup setup_;
  NextBestViewOptions options_;
  TriedViews tried_;
  NextBestViewExplorer explorer_;
  FollowingCaster looking_;  // in the map that was planned in last
};

}  // namespace vantage
