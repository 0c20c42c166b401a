// SPDX-License-Identifier: MIT
#pragma once

//
// Vasquez-Gomez, Sucar, Murrieta-Cid 2013, "Hierarchical ray tracing for fast volumetric next-best-view planning".
#include <utility>
#include <vantage/view/view_utility.hpp>

namespace vantage {

VANTAGE_INLINE std::function<double(const Pose&, const ViewEvaluation&)> minimum_overlap(std::size_t min_occupied) {
  return [min_occupied](const Pose&, const ViewEvaluation& seen) {
    return seen.occupied < min_occupied ? 0.0 : 1.0;  // Equation (2)
  };
}

VANTAGE_INLINE std::function<double(const Pose&, const ViewEvaluation&)> unknown_cells() {
  return [](const Pose&, const ViewEvaluation& seen) { return static_cast<double>(seen.unknown); };  // Equation (4)
}

VANTAGE_INLINE std::function<double(const Pose&)> nearness(std::function<double(const Pose&)> rho_m) {
  return [rho_m = std::move(rho_m)](const Pose& pose) { return 1.0 / (1.0 + rho_m(pose)); };  // Equation (5)
}

VANTAGE_INLINE std::vector<ScoredView> score_views(std::span<const Pose> candidates, const EvaluateViews& evaluate,
                                                   const UtilityFactors& factors) {
  std::vector<ScoredView> scored(candidates.size());
  std::vector<std::size_t> admitted;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    scored[i].pose = candidates[i];
    if (!factors.position || factors.position(candidates[i])) {
      admitted.push_back(i);
      poses.push_back(candidates[i]);
    }
  }
  const std::vector<ViewEvaluation> seen = evaluate(poses);
  for (std::size_t i = 0; i < admitted.size(); ++i) {
    ScoredView& view = scored[admitted[i]];
    view.seen = seen[i];
    view.utility = 1.0;  // Equation (1)
    if (factors.registration) {
      view.utility *= factors.registration(view.pose, view.seen);
    }
    if (factors.surface && view.utility != 0.0) {
      view.utility *= factors.surface(view.pose, view.seen);
    }
    if (factors.distance && view.utility != 0.0) {
      view.utility *= factors.distance(view.pose);
    }
  }
  return scored;
}

VANTAGE_INLINE std::vector<ScoredView> score_views(const RayCaster& caster, std::span<const Pose> candidates,
                                                   const ViewRays& rays, const VoxelBox& object,
                                                   const UtilityFactors& factors, std::size_t threads) {
  return score_views(
      candidates, [&](std::span<const Pose> views) { return evaluate_views(caster, views, rays, object, threads); },
      factors);
}

}  // namespace vantage
