// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/view/aimed_views.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// The box of an object and its candidate views.
struct ObjectViewOptions {
  Box object;  ///< box of the object, metres, world, min < max
  /// Radii of the candidate spheres around the centre of the object, metres, each > 0; none: one `fitting_radius_m`.
  /// Candidates look at the centre (Vasquez-Gomez et al. 2013, VI-A).
  std::vector<double> radii_m = {};
  /// Candidates per sphere: 20 * 4^subdivisions, evenly distributed, in [-1, 6]; -1: none. The paper uses 320.
  int subdivisions = 2;
  /// Additional candidates that look at the object from random places in the region or, without a region, in the
  /// known part of the map (VI-B).
  std::size_t random_candidates = 0;
  /// Draws of additional candidates that aim at what is not yet seen of the object, from a third of the largest
  /// radius up to it, for each plan (aimed_views).
  std::size_t aimed_candidates = 320;

  /// The options of the aimed candidates. Throws std::invalid_argument if `radii_m` is empty.
  [[nodiscard]] AimedViewOptions aimed() const;
};

/// Radius of a sphere around the centre of a box, metres, for candidates that look at the centre: so far that a
/// sphere around the box fits into the image, but so near that the sensor resolves cells of `resolution_m` and
/// reaches the far side of the box. A body that reaches `body_m` from the sensor does not touch the box there.
[[nodiscard]] double fitting_radius_m(const Box& box, const RangeSensor& sensor, double resolution_m, double body_m);

/// The options with radii, if there are none: `fitting_radius_m` for `Platform::reach_m`, if it is finite, or
/// at least a cell, and two cells beside it.
[[nodiscard]] ObjectViewOptions with_radii(const ObjectViewOptions& options, const RangeSensor& sensor,
                                           const Platform& platform, double resolution_m);

/// The candidate views of an object that the platform admits, in orientations that it can take: on the spheres, at
/// random places, then `aimed`. Equal seeds give equal views. Throws std::invalid_argument if `radii_m` is empty.
[[nodiscard]] std::vector<Pose> views_of_object(const ObjectViewOptions& options, const OccupancyMap& map,
                                                const Platform& platform, std::span<const Pose> aimed,
                                                std::uint64_t seed);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/object_views.ipp>
#endif
