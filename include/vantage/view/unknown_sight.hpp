// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What the unknown is thought to be like.
struct UnknownSightOptions {
  /// Chance that one of the wanted cells stops a ray, in (0, 1]; 1: none is seen but the first of each ray.
  double opaque_share = 1.0;
  /// The same for those of which a face neighbour is known to be occupied, in (0, 1]: most likely the surface goes
  /// on.
  double opaque_beside_surface = 1.0;
  /// RangeSensor::reports_no_return.
  bool reports_no_return = false;
};

/// A cell, and the chance that a view comes to know it.
struct SightedCell {
  VoxelIndex cell;      ///< one of the wanted
  double chance = 0.0;  ///< in (0, 1]
};

/// What a view is expected to learn of unknown cells, where sight may go on beyond the first of them.
///
/// A ray counts if the first cell on it that is not free is a wanted one. Each wanted cell stops it with the chance
/// p, on its own; other unknown cells behind the first do not. So a ray reaches one of them with the product of 1 - p
/// of those before. A sensor that does not report rays without return learns nothing from one that leads into the
/// open: with no surface known behind the wanted cells on the way, it meets one in them or behind with 1 less the
/// product of 1 - p of those. A surface known nearer than the sensor's shortest range returns nothing either. A cell
/// on several rays has the chance of the best of them, which is the least it can be.
class UnknownSight {
 public:
  /// Takes what the map knows now of `wanted`, unknown cells, and around them. Throws std::invalid_argument naming
  /// the option at fault.
  UnknownSight(const OccupancyMap& map, std::span<const VoxelIndex> wanted, const UnknownSightOptions& options);

  /// The wanted cells that a view may come to know, in raster order. Cells whose centre is nearer than the sensor's
  /// shortest range are passed, but not counted. `caster` looks at the same map as it is now. Errors as
  /// RayCaster::cast.
  [[nodiscard]] std::vector<SightedCell> look(const RayCaster& caster, const Pose& world_from_sensor,
                                              const ViewRays& rays) const;

 private:
  enum class Content : std::uint8_t { Open, Wanted, WantedBesideSurface, Surface };
  struct Ray;
  class Chances;
  void follow(const Ray& ray, Chances& chances) const;

  VoxelFrame frame_;
  UnknownSightOptions options_;
  VoxelBox wanted_box_;
  VoxelGrid<Content> contents_;
};

}  // namespace vantage
