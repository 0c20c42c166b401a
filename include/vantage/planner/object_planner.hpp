// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/tried_views.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/aimed_views.hpp>
#include <vantage/view/unseen_surface.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Options of ObjectPlanner.
struct ObjectPlannerOptions {
  Box object;                           ///< the box of the object, metres
  std::vector<double> radii_m = {1.5};  ///< candidates look at its middle from shells this far off, > 0
  int subdivisions = 2;                 ///< those of a shell are 20 * 4^this, in [-1, 6]; -1: none
  std::size_t random_candidates = 0;    ///< as many more, from places drawn in the region
  AimedViewOptions aimed = {};          ///< and these, aimed at what is left to be seen
  double min_new_share = 0.002;  ///< a view must be expected to show this share of the surface seen so far, in [0, 1)
  double near_share = 0.7;  ///< of views expected to show this share of what the best would, the nearest is taken; in
                            ///< (0, 1]
};

/// Takes the view that is expected to show most of the surface of an object that no view has shown (UnseenSurface).
/// The run is over when no admitted candidate is expected to show any that is worth a view.
///
/// Beside the map it remembers which sides of the surface were looked at. One that begins anew with a map looks again
/// at sides of which the map cannot tell.
class ObjectPlanner final : public ExplorationPlanner {
 public:
  /// Throws std::invalid_argument naming the option at fault.
  ObjectPlanner(const PlannerSetup& setup, const ObjectPlannerOptions& options);

  /// "next-best-view".
  [[nodiscard]] std::string_view name() const override { return "next-best-view"; }
  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& pose) override;
  void report(const OccupancyMap& /*map*/, const Pose& /*current*/, GoalResult result) override {
    tried_.report(result);
  }

 private:
  struct Candidate {
    Pose pose;
    std::vector<UnseenSurface::Face> faces;  // that it is expected to be the first to look at
    double way_m = 0.0;
  };
  void follow(const OccupancyMap& map, const Pose& current);
  [[nodiscard]] std::vector<Candidate> candidates(const OccupancyMap& map, const Pose& current) const;
  [[nodiscard]] std::vector<std::size_t> order_of(const std::vector<Candidate>& tried) const;
  [[nodiscard]] bool take_first(const OccupancyMap& map, const Pose& current,
                                const std::vector<Candidate>& worthwhile, Plan& plan) const;
  [[nodiscard]] double way_m(const Pose& from, const Pose& to) const;

  PlannerSetup setup_;
  ObjectPlannerOptions options_;
  KnownMap map_;  // that was planned in last
  OccupancyMap::Revision revision_ = 0;
  TriedViews tried_;  // goals that the robot failed to get to
  std::optional<UnseenSurface> surface_;
  std::optional<ViewRays> rays_;
};

}  // namespace vantage
