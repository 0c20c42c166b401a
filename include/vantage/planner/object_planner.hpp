// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vantage/compiler.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/planner_setup.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/object_views.hpp>
#include <vantage/view/tried_views.hpp>
#include <vantage/view/unseen_surface.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Candidate views of ObjectPlanner, its end condition and the cost of a view.
struct ObjectPlannerOptions {
  ObjectViewOptions candidates;  ///< the box of the object and its candidate views
  /// Minimum weight of the sides of the surface that a view is expected to observe first, as a share of the weight
  /// observed so far, in [0, 1).
  double min_new_share = 0.001;
  /// What a view costs beside the path to it, in radii of the first sphere, in (0, 1e6]. The planner takes
  /// the view of largest weight / (price + path length): a small price saves path, a large one saves views.
  double view_price = 4.0;
};

/// Reconstructs one object. A view counts by the weight of the sides of surface cells that it is expected to be
/// the first to observe (UnseenSurface); the planner takes the view of most weight for its cost. The run ends when
/// no admitted candidate reaches ObjectPlannerOptions::min_new_share.
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
  [[nodiscard]] std::string memory() const override { return tried_.text(); }
  void recall(const OccupancyMap& map, std::string_view memory) override { tried_.recall(map, memory); }

 private:
  struct Candidate {
    Pose pose;
    std::size_t shows = 0;  // weight of the sides that it is expected to be the first to observe
    double way_m = 0.0;
  };
  void follow(const OccupancyMap& map, const Pose& current);
  [[nodiscard]] std::vector<Candidate> candidates(const OccupancyMap& map, const Pose& current) const;
  [[nodiscard]] std::vector<std::size_t> order_of(const std::vector<Candidate>& tried) const;
  [[nodiscard]] bool take_first(const OccupancyMap& map, const Pose& current, const std::vector<Candidate>& all,
                                const std::vector<std::size_t>& worthwhile, Plan& plan);
  [[nodiscard]] double way_m(const Pose& from, const Pose& to) const;

  PlannerSetup setup_;
  ObjectPlannerOptions options_;
  ObjectViewOptions shells_;  // options_.candidates, with radii
  KnownMap map_;              // of the last plan
  OccupancyMap::Revision revision_ = 0;
  TriedViews tried_;  // goals that the robot failed to get to
  std::optional<UnseenSurface> surface_;
  std::optional<ViewRays> rays_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/object_planner.ipp>
#endif
