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

/// The factors of the utility of a view, u(v) = pos(v) reg(v) sur(v) dist(v). Each factor can be replaced by your own
/// function; a missing one is 1. They are evaluated in the order below. If one is 0, the later ones are not called
/// for that view. `position` is called before the view is evaluated, because evaluation is the most expensive part.
/// (Vasquez-Gomez et al. 2013, eq. 1.)
struct UtilityFactors {
  /// Positioning: whether the sensor can take the pose (IV-A.1).
  std::function<bool(const Pose&)> position = nullptr;
  /// Registration: whether a scan from the pose would overlap enough with known surface (eq. 2).
  std::function<double(const Pose&, const ViewEvaluation&)> registration = nullptr;
  /// New surface: how much the view may make known (eq. 3, 4).
  std::function<double(const Pose&, const ViewEvaluation&)> surface = nullptr;
  /// Distance: what it costs to reach the pose (eq. 5).
  std::function<double(const Pose&)> distance = nullptr;
};

/// Eq. 2: 1 if the view sees at least `min_occupied` occupied cells of the object, otherwise 0.
[[nodiscard]] std::function<double(const Pose&, const ViewEvaluation&)> minimum_overlap(std::size_t min_occupied);
/// Eq. 4: the number of unknown cells of the object that the view sees.
[[nodiscard]] std::function<double(const Pose&, const ViewEvaluation&)> unknown_cells();
/// Eq. 5: 1 / (1 + rho), where `rho_m(pose)` is the distance to a view in metres.
[[nodiscard]] std::function<double(const Pose&)> nearness(std::function<double(const Pose&)> rho_m);

/// A candidate view and its utility.
struct ScoredView {
  Pose pose = Pose::Identity();  ///< world_from_sensor
  ViewEvaluation seen;           ///< what it sees of the object; zero if `position` rejected it
  double utility = 0.0;          ///< product of the factors
};

/// Evaluates views: returns what each of them sees, in the same order.
using EvaluateViews = std::function<std::vector<ViewEvaluation>(std::span<const Pose>)>;

/// Scores all candidates; the result has their order. The candidates that `position` accepts are evaluated in one
/// call. Throws whatever `evaluate` or a factor throws.
[[nodiscard]] std::vector<ScoredView> score_views(std::span<const Pose> candidates, const EvaluateViews& evaluate,
                                                  const UtilityFactors& factors);

/// Scores all candidates with evaluate_views on `threads` threads. The result does not depend on the number of
/// threads. The factors are called only from the calling thread. Errors as evaluate_views, and whatever a factor
/// throws.
[[nodiscard]] std::vector<ScoredView> score_views(const RayCaster& caster, std::span<const Pose> candidates,
                                                  const ViewRays& rays, const VoxelBox& object,
                                                  const UtilityFactors& factors, std::size_t threads = 1);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/view_utility.ipp>
#endif
