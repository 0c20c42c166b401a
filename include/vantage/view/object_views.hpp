// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/view/aimed_views.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Where to look at an object from.
struct ObjectViewOptions {
  Box object;  ///< box of the object, metres, world, min < max
  /// Radii of the candidate spheres around the centre of the object, metres, each > 0, at least one. Candidates look
  /// at the centre (Vasquez-Gomez et al. 2013, VI-A).
  std::vector<double> radii_m = {1.5};
  /// Candidates per sphere: 20 * 4^subdivisions, evenly distributed, in [-1, 6]; -1: none. The paper uses 320.
  int subdivisions = 2;
  /// Additional candidates that look at the object from random places in the region or, without a region, in the
  /// known part of the map (VI-B).
  std::size_t random_candidates = 0;
  /// Additional candidates that aim at what is not yet seen of the object, computed for each plan.
  AimedViewOptions aimed = {};
};

/// Throws std::invalid_argument, which names the invalid option.
void validate(const ObjectViewOptions& options);

/// The candidate views of an object that the platform admits, in orientations that it can take: on the spheres, at
/// random places, then `aimed`. Equal seeds give equal views.
[[nodiscard]] std::vector<Pose> views_of_object(const ObjectViewOptions& options, const OccupancyMap& map,
                                                const Platform& platform, std::span<const Pose> aimed,
                                                std::uint64_t seed);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/object_views.ipp>
#endif
