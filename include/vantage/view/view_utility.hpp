// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The factors of `u(v) = pos(v) reg(v) sur(v) dist(v)`, the utility of a view (Vasquez-Gomez et al. 2013, eq. 1).
/// Each may be replaced by one of your own; what is not given is 1. They are asked in the order below, as a cascade:
/// a view for which one is 0 costs nothing more. `pos` is asked before the view is evaluated, which is what costs
/// most.
struct UtilityFactors {
  /// Positioning: whether the sensor can be there (IV-A.1).
  std::function<bool(const Pose&)> position = nullptr;
  /// Registration: whether a scan from there would fit to what is known (eq. 2).
  std::function<double(const Pose&, const ViewEvaluation&)> registration = nullptr;
  /// New surface: what the view may learn (eq. 3, 4).
  std::function<double(const Pose&, const ViewEvaluation&)> surface = nullptr;
  /// Distance: what it costs to get there (eq. 5).
  std::function<double(const Pose&)> distance = nullptr;
};

/// Eq. 2: 1 for a view that sees at least `min_occupied` occupied cells of the object, else 0.
[[nodiscard]] std::function<double(const Pose&, const ViewEvaluation&)> minimum_overlap(std::size_t min_occupied);
/// Eq. 4: the number of unknown cells of the object that a view sees.
[[nodiscard]] std::function<double(const Pose&, const ViewEvaluation&)> unknown_cells();
/// Eq. 5: 1 / (1 + rho), where `rho_m(pose)` is the distance to a view, metres.
[[nodiscard]] std::function<double(const Pose&)> nearness(std::function<double(const Pose&)> rho_m);

/// A candidate and what it is worth.
struct ScoredView {
  Pose pose = Pose::Identity();  ///< world_from_sensor
  ViewEvaluation seen;           ///< what it sees of the object; nothing where `position` refused it
  double utility = 0.0;          ///< the product of the factors; 0 where one of them is
};

/// How views are evaluated: what each of them sees, in their order.
using EvaluateViews = std::function<std::vector<ViewEvaluation>(std::span<const Pose>)>;

/// Scores every candidate, in their order; those that `position` admits are evaluated, all in one call. Throws
/// whatever `evaluate` or a factor throws.
[[nodiscard]] std::vector<ScoredView> score_views(std::span<const Pose> candidates, const EvaluateViews& evaluate,
                                                  const UtilityFactors& factors);

/// The same by evaluate_views, on this many threads; the result does not depend on their number.
/// Factors are called from the calling thread only. Errors as evaluate_views, and whatever a factor throws.
[[nodiscard]] std::vector<ScoredView> score_views(const RayCaster& caster, std::span<const Pose> candidates,
                                                  const ViewRays& rays, const VoxelBox& object,
                                                  const UtilityFactors& factors, std::size_t threads = 1);

}  // namespace vantage
