// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/unknown_sight.hpp>
#include <vantage/view/utility_vectors.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What FrontierVoidPlanner does that the paper leaves open or does otherwise; docs/frontier_void.md says what each
/// part earns.
struct FrontierVoidStrategy {
  /// Which frontier cells a void is looked into through.
  FrontierShare share = FrontierShare::TouchingCells;
  /// Orientations tried at a place, >= 1; a sensor that sees all around has one.
  std::size_t orientations_per_place = 5;
  /// Places are at least so far apart, metres, >= 0: those of most utility lie side by side and see the same.
  double place_spacing_m = 0.3;
  /// Orientations look at the frontier of a void, drawn by its utility, instead of anywhere.
  bool aimed = true;
  /// Places and views are ranked by void cells / (1 + this * metres to the place, straight), >= 0; 0: void cells
  /// alone count (eq. 3).
  double cost_per_m = 0.3;
  /// Of the finalists the best by the metres of the way there is taken, not by the straight line: behind a wall is
  /// far.
  bool along_way = false;
  /// So many views from the nearest places that see a void through its frontier are weighed besides, >= 0: places and
  /// directions are drawn by the size of voids, which passes by the small ones.
  std::size_t near_views = 0;
  /// All views are counted by a sixteenth of the rays first, and the best so many of them by all, >= 1.
  std::size_t finalists = 5;
  /// So many views like the best of them, moved by up to `place_spacing_m` and turned by up to half a radian, are
  /// counted, too, >= 0; a better one takes its place at once.
  std::size_t refinements = 0;
  /// UnknownSightOptions::opaque_share of void cells: what a view is expected to learn behind the first void cell of
  /// a ray counts, too. 1: the first alone.
  double opaque_share = 0.05;
  double opaque_beside_surface = 0.5;  ///< UnknownSightOptions::opaque_beside_surface of void cells
  /// A view has failed to resolve void cells that it was to make known with at least this chance, in [0, 1], where
  /// they are still unknown after it: with 1 only those that its rays surely end in.
  double sought_chance = 1.0;
  /// A view that is expected to learn less of the voids than this, m^3, is none, >= 0.
  double least_view_m3 = 0.0;
  /// When no view sees a void any more, frontiers that border none are explored, the nearest first.
  bool beyond_voids = true;

  /// The paper's plain method, which ends when the best utility is 0: Explored where nothing observable is left,
  /// else Blocked.
  [[nodiscard]] static FrontierVoidStrategy faithful() {
    return {.share = FrontierShare::WholeClusters,
            .place_spacing_m = 0.0,
            .aimed = false,
            .cost_per_m = 0.0,
            .finalists = std::numeric_limits<std::size_t>::max(),
            .opaque_share = 1.0,
            .opaque_beside_surface = 1.0,
            .beyond_voids = false};
  }
  /// For a body to which metres matter and views do not: what is near is finished before it goes on.
  [[nodiscard]] static FrontierVoidStrategy travelling() {
    return {.cost_per_m = 100.0, .along_way = true, .near_views = 20};
  }
  /// For a camera on an arm, whose reach is short and whose views are dear: many views are weighed, metres do not
  /// count, and the search ends where no view sees a void.
  [[nodiscard]] static FrontierVoidStrategy searching() {
    return {.orientations_per_place = 8,
            .place_spacing_m = 0.1,
            .cost_per_m = 0.0,
            .finalists = 30,
            .sought_chance = 0.0,
            .beyond_voids = false};
  }
};

/// Options of FrontierVoidPlanner.
struct FrontierVoidOptions {
  VoidClusterOptions clusters = {};    ///< how void cells are clustered; its seed is the setup's
  std::size_t most_vectors = 200'000;  ///< see utility_vectors, > 0
  std::size_t views = 50;              ///< valid views evaluated per plan, `N` in IV-C, >= 1
  FrontierVoidStrategy strategy = {};  ///< what to make of the voids
  /// Fewer directions than elsewhere: a void is looked into through many frontier cells.
  FrontierSurveyOptions survey = {.sight_directions = 128};
};

/// What a plan of FrontierVoidPlanner was made from, for pictures and for those who want to look.
struct VoidSearch {
  VoidClusters voids;                        ///< all void cells
  std::vector<FrontierVoid> frontier_voids;  ///< those with an observable frontier
  std::vector<VoxelIndex> frontier;          ///< the observable frontier cells
  std::vector<VoxelIndex> places;            ///< reachable cells with a utility
  std::vector<std::uint64_t> utility;        ///< and what each has accumulated (Algorithm 1), in void cells
  std::optional<Pose> view;                  ///< the view that was chosen; none where none sees a void
};

/// The search of voids of Dornhege & Kleiner 2011: voids, the frontiers through which they can be seen, places from
/// which many of them can be (Algorithm 1), and of N views from the best places the one that sees most void cells
/// (eq. 3).
///
/// The utility of a view is the number of distinct void cells that its rays end in, counted exactly. Of the frontier
/// only what the survey that all planners share finds observable is looked through, so the search ends when
/// everything is seen that can be, and what is left is reported by cause. docs/frontier_void.md names the place of
/// every equation.
class FrontierVoidPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument naming the option or the part of the setup at fault.
  explicit FrontierVoidPlanner(const PlannerSetup& setup, const FrontierVoidOptions& options = {});

  /// "frontier-void".
  [[nodiscard]] std::string_view name() const override { return "frontier-void"; }

  /// The options it was made with.
  [[nodiscard]] const FrontierVoidOptions& options() const { return options_; }
  /// What the last plan was made from; empty where nothing observable was left.
  [[nodiscard]] const VoidSearch& search() const { return search_; }

 private:
  struct Candidate {
    Pose pose;
    std::size_t void_cells = 0;
    double value = 0.0;
  };

  void prepare(Plan& plan) override;
  [[nodiscard]] std::optional<ChosenView> choose(Plan& plan) override;
  [[nodiscard]] std::vector<SightedCell> void_cells_seen(const Pose& view, const ViewRays& rays) const;
  void extract();
  void accumulate(PlanStatistics& statistics);
  [[nodiscard]] std::vector<Pose> sample_views(PlanStatistics& statistics) const;
  [[nodiscard]] std::vector<Pose> views_of(const std::vector<const FrontierTarget*>& targets, std::size_t most,
                                           PlanStatistics& statistics) const;
  [[nodiscard]] std::vector<Pose> near_views(PlanStatistics& statistics) const;
  [[nodiscard]] std::vector<Pose> views_of_voids(PlanStatistics& statistics) const;
  [[nodiscard]] double discounted(double utility, double way_m) const;
  [[nodiscard]] std::vector<Candidate> rank(std::vector<Candidate> candidates, const ViewRays& rays) const;
  void refine(std::vector<Candidate>& candidates, PlanStatistics& statistics) const;
  [[nodiscard]] std::optional<ChosenView> best_of(const std::vector<Pose>& views, Plan& plan) const;
  [[nodiscard]] std::optional<std::vector<Pose>> way_to(const Pose& view) const;
  [[nodiscard]] std::optional<ChosenView> nearest_frontier(PlanStatistics& statistics) const;

  FrontierVoidOptions options_;
  VoidSearch search_;
  // Of the map that was planned in last:
  KnownMap followed_;
  std::optional<UnknownSight> sight_;
  std::optional<VoidTracker> void_cells_;
  std::optional<ViewRays> sparse_rays_;
};

}  // namespace vantage
