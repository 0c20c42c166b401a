// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/aimed_views.hpp>
#include <vantage/view/tried_views.hpp>
#include <vantage/view/unseen_surface.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Options of ObjectPlanner.
struct ObjectPlannerOptions {
  Box object;  ///< box of the object, metres, world, min < max
  /// Radii of the candidate spheres around the centre of the object, metres, each > 0, at least one.
  std::vector<double> radii_m = {1.5};
  int subdivisions = 2;  ///< candidates per sphere: 20 * 4^subdivisions, in [-1, 6]; -1: none
  /// Number of additional candidates from random places in the region or, without one, the known space
  std::size_t random_candidates = 0;
  AimedViewOptions aimed = {};  ///< additional candidates that aim at surface that is not yet observed
  /// Minimum expected number of new faces of a view, as a share of the faces observed so far, in [0, 1).
  double min_new_share = 0.002;
  /// Of the views whose expected gain is at least this share of the best one's, the nearest is taken, in (0, 1].
  double near_share = 0.7;
};

/// Reconstructs one object: takes a view that is expected to observe most faces of its surface that no view has
/// observed yet (UnseenSurface). The run ends when no admitted candidate is expected to observe enough of them.
///
/// Unlike other planners, it remembers which sides of the surface were observed, which the map does not store. A new
/// planner for an existing map looks at some sides again.
class ObjectPlanner final : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument, which names the invalid option or part of the setup.
  ObjectPlanner(const PlannerSetup& setup, const ObjectPlannerOptions& options);

  [[nodiscard]] std::string_view name() const override { return "next-best-view"; }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& pose) override;
  void report(const OccupancyMap& /*map*/, const Pose& /*current*/, GoalResult result) override {
    tried_.report(result);
  }

 private:
  struct Candidate {
    Pose pose;
    std::vector<UnseenSurface::Face> faces;  // that it is expected to be the first to observe
    double way_m = 0.0;
  };
  void follow(const OccupancyMap& map, const Pose& current);
  [[nodiscard]] std::vector<Candidate> candidates(const OccupancyMap& map, const Pose& current) const;
  [[nodiscard]] std::vector<std::size_t> order_of(const std::vector<Candidate>& tried) const;
  [[nodiscard]] bool take_first(const OccupancyMap& map, const Pose& current, const std::vector<Candidate>& all,
                                const std::vector<std::size_t>& worthwhile, Plan& plan) const;
  [[nodiscard]] double way_m(const Pose& from, const Pose& to) const;

  PlannerSetup setup_;
  ObjectPlannerOptions options_;
  KnownMap map_;  // of the last plan
  OccupancyMap::Revision revision_ = 0;
  TriedViews tried_;  // goals that the robot failed to get to
  std::optional<UnseenSurface> surface_;
  std::optional<ViewRays> rays_;
};

}  // namespace vantage
