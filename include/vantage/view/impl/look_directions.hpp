// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vantage/raytrace/following_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/target_view.hpp>
#include <vantage/view/unknown_sight.hpp>
#include <vector>

#include <vantage/view/impl/targets_in_sight.hpp>

namespace vantage::detail {

/// A view and its expected gain.
struct Look {
  TargetView seen;               ///< the view and the targets that it sees
  double cells = 0.0;            ///< expected number of unknown cells that it resolves (UnknownSight)
  std::uint64_t operations = 0;  ///< cells on its rays
};

/// Chooses the orientation of a sensor with a limited field of view at a given place: among directions spread over
/// the sphere, as the platform can take them, the one with the highest expected gain. Only orientations that see a
/// target count.
class LookDirections {
 public:
  /// For the place `position` (metres, world). Adds the number of cells visited by rays to `operations`, also later.
  LookDirections(const SurveyedMap& surveyed, const Eigen::Vector3d& position, std::uint64_t& operations);

  /// The best view, by the rays of `looking`, which follows the map. With `wanted`, only views that see this cell; it
  /// must be in sight from here. None if there is no such view.
  [[nodiscard]] std::optional<Look> best(const FollowingCaster& looking, int threads,
                                         const std::optional<VoxelIndex>& wanted = std::nullopt) const;

  /// Whether orientations can be compared: the sensor does not see all around, and the map has more than one layer of
  /// cells (in one layer, the rows of an image lead out of the map).
  [[nodiscard]] static bool choosable(const OccupancyMap& map, const RangeSensor& sensor);

 private:
  void count_expected_cells(Look& look, const RayCaster& caster, const ViewRays& rays) const;
  [[nodiscard]] bool was_in_view(const VoxelIndex& cell) const;

  SurveyedMap surveyed_;
  Eigen::Vector3d position_;
  VoxelIndex place_;
  TargetsInSight targets_;
  std::optional<UnknownSight> sight_;
  std::uint64_t& operations_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/look_directions.ipp>
#endif
