// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/frontier/void_cluster_tracker.hpp>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/map/following.hpp>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/view/unknown_sight.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What FrontierVoidPlanner makes of voids. Each mode fixes how voids are clustered, views are drawn and rays are
/// counted (docs/frontier_void.md).
enum class VoidMode : std::uint8_t {
  Exploring,  ///< for a robot that moves: a view counts the void cells that it probably sees, behind the first ones
              ///< too
  /// the plain method of the paper: all voids are clustered together, and only the first void cell of a ray counts
  Faithful,
  Searching,  ///< for a camera on an arm, whose views are expensive: compares many views with all their rays
};

/// How FrontierVoidPlanner ranks views and when it ends.
struct FrontierVoidStrategy {
  VoidMode mode = VoidMode::Exploring;  ///< what to make of voids
  std::size_t views = 50;               ///< valid views evaluated per plan, `N` in IV-C, in [1, 1e6]
  /// Places and views are ranked by void cells / (1 + cost_per_m * straight distance in metres), >= 0. 0: void cells
  /// alone count (eq. 3).
  double cost_per_m = 0.3;
  /// Minimum expected volume of voids that a view must observe, m^3, >= 0.
  double least_view_m3 = 0.0;
  /// True: when no view sees a void any more, frontiers that border no void are explored, the nearest first.
  bool beyond_voids = true;

  /// The plain method of the paper. It ends when the best utility is 0: Explored if nothing observable is left, else
  /// Blocked.
  [[nodiscard]] static FrontierVoidStrategy faithful() {
    return {.mode = VoidMode::Faithful, .cost_per_m = 0.0, .beyond_voids = false};
  }
  /// For a camera on an arm, with a short reach and expensive views: compares many views, ignores distance, and ends
  /// when no view sees a void of more than 1.6 dm^3, just below the smallest utility in the paper's tables.
  [[nodiscard]] static FrontierVoidStrategy searching() {
    return {
        .mode = VoidMode::Searching, .views = 400, .cost_per_m = 0.0, .least_view_m3 = 0.0016, .beyond_voids = false};
  }
};

/// All options of FrontierVoidPlanner. Settings (make_planner) set some of them by name.
struct FrontierVoidOptions {
  VoidClusterOptions clusters = {};    ///< how void cells are clustered; its seed is replaced by that of the setup
  FrontierVoidStrategy strategy = {};  ///< refinements of the method
  /// How frontiers are surveyed, with fewer rays than elsewhere: a void is seen through many frontier cells.
  FrontierSurveyOptions survey = {.sight_directions = 128};
};

/// Intermediate results of a plan of FrontierVoidPlanner, for display.
struct VoidSearch {
  VoidClusters voids;  ///< clusters of the void cells that views could see, when a view was last chosen
  std::vector<FrontierVoid> frontier_voids;  ///< voids with an observable frontier
  std::vector<VoxelIndex> frontier;          ///< observable frontier cells
  std::vector<VoxelIndex> places;            ///< reachable cells with a utility above 0
  std::vector<std::uint64_t> utility;        ///< the accumulated utility of each place, in void cells (Algorithm 1)
  std::optional<Pose> view;                  ///< the chosen view; none if no view sees a void
};

/// Searches voids: unknown cells inside the convex hull of the occupied ones. A plan takes four steps:
///
///     void cells  ->  clusters with the frontier through which they can be observed   (IV-A, IV-B)
///                 ->  utility of each reachable place: rays back from the frontier    (Algorithm 1)
///                 ->  N views at the places of highest utility                        (IV-C)
///                 ->  the view that observes most distinct void cells, by ray casting (eq. 3)
///
/// Only frontier cells that the shared survey finds observable are used, and only void cells that are as near to one
/// of them as the sensor's range: a view sees no others, and the hull may be far larger. If there are very many of
/// these frontier cells, those far away are used only when no view of a void behind the nearest ones is found. So the
/// search ends when everything observable is seen, and the leftover is reported by cause. docs/frontier_void.md lists
/// where each equation is implemented. (Dornhege & Kleiner 2011.)
class FrontierVoidPlanner final : public FrontierPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  explicit FrontierVoidPlanner(const PlannerSetup& setup, const FrontierVoidOptions& options = {});

  [[nodiscard]] std::string_view name() const override { return "frontier-void"; }

  /// The intermediate results of the last plan. If no observable frontier was left, they are empty, except that
  /// the clusters are still those of an earlier plan.
  [[nodiscard]] const VoidSearch& search() const { return search_; }

 private:
  struct Candidate {
    View view;  // its utility is the expected number of void cells
    double value = 0.0;
    std::uint64_t operations = 0;        // cells on its rays
    std::vector<SightedCell> seen = {};  // with all rays; empty if there are many candidates
  };

  void clear_search();
  PlanStatistics prepare(const Situation& situation) override;
  [[nodiscard]] Choice choose(const Situation& situation) override;
  [[nodiscard]] std::vector<SightedCell> void_cells_seen(const Situation& situation, const Pose& view,
                                                         const ViewRays& rays, std::uint64_t& operations) const;
  void choose_view_of_voids(const Situation& situation, std::size_t most_targets, Choice& choice);
  [[nodiscard]] std::vector<double> search_places(const Situation& situation, std::size_t most_targets,
                                                  PlanStatistics& statistics);
  void choose_best(const Situation& situation, const std::vector<Pose>& views, Choice& choice) const;

  FrontierVoidOptions options_;
  VoidSearch search_;
  Following<VoidTracker> void_cells_;
  VoidClusterTracker clusters_;
  OccupancyMap::Revision clustered_ = 0;  // of the map of `search_.voids` and `sight_`
  std::vector<VoxelBox> near_;            // where these were searched
  std::optional<UnknownSight> sight_;     // none: the voids are yet to be clustered
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/frontier_void_planner.ipp>
#endif
