// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/frontier/frontier_voids.hpp>
#include <vantage/view/target_view.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How views of voids are drawn.
struct VoidSampling {
  /// Orientations tried per place, >= 1; one is enough for a sensor that sees all around.
  std::size_t orientations_per_place = 5;
  /// Minimum distance between places, metres, in [0, 1e6]. The places of highest utility lie side by side and see the
  /// same.
  double place_spacing_m = 0.3;
  /// True: orientations look at a frontier cell of a void, drawn with its utility as weight. False: in random
  /// directions.
  bool aimed = true;
};

/// Candidate views of voids. All of them are admitted by the platform. (Dornhege & Kleiner 2011, IV-C.)
class VoidViews {
 public:
  /// What `surveyed` refers to, and `operations`, must outlive the object. All functions add the number of cells
  /// that their rays visit to `operations`.
  VoidViews(const SurveyedMap& surveyed, const VoidClusters& voids, std::uint64_t& operations);

  /// Draws orientations at `places` (reachable cells), in descending order of `values` (one per place), until
  /// there are `count` views or no place is left.
  [[nodiscard]] std::vector<Pose> draw(std::span<const VoxelIndex> places, std::span<const double> values,
                                       std::span<const FrontierVoid> voids, const VoidSampling& sampling,
                                       std::size_t count, std::uint64_t seed) const;
  /// Views of at most `most` (> 0) targets whose unknown cell is in a void, evenly spread over the survey.
  [[nodiscard]] std::vector<Pose> of_targets(std::size_t most) const;

 private:
  SurveyedMap surveyed_;
  std::vector<FrontierTarget> targets_;  // those whose unknown cell belongs to a void
  std::uint64_t& operations_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/void_views.ipp>
#endif
