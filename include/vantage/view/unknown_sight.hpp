// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/brick_grid.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Assumptions about the content of unknown cells.
struct UnknownSightOptions {
  /// Probability that a wanted cell (see UnknownSight) stops a ray, in (0, 1]. With 1, only the first wanted cell
  /// of each ray is seen.
  double opaque_share = 1.0;
  /// Probability that a wanted cell with an occupied face neighbour stops a ray, in (0, 1]: the surface probably
  /// continues there.
  double opaque_beside_surface = 1.0;
  /// Whether the sensor reports rays without a return, see RangeSensor::reports_no_return.
  bool reports_no_return = false;
};

/// A cell and the probability that a view observes it.
struct SightedCell {
  VoxelIndex cell;      ///< one of the wanted cells of UnknownSight
  double chance = 0.0;  ///< probability that the view observes the cell, in (0, 1]
};

/// Predicts which unknown cells a view will observe, where rays may pass beyond the first unknown cell.
///
/// Model: a ray counts if its first cell that is not free is a wanted one. Each wanted cell stops it independently
/// with probability p (see UnknownSightOptions); other unknown cells behind the first do not stop it. So the ray
/// reaches a cell with the product of (1 - p) of the wanted cells before it. A sensor that does not report missing
/// returns observes nothing along a ray that meets no surface. If no known surface lies behind the wanted cells, the
/// probability of a cell is therefore that the ray reaches it and stops in it or in a wanted cell behind it. A ray to
/// a known surface within the minimum range also returns nothing. If several rays pass a cell, the best one counts,
/// which is a lower bound.
class UnknownSight {
 public:
  /// `wanted` must be unknown cells of the map, which must outlive this object and not change. Throws
  /// std::invalid_argument, which names the invalid option.
  UnknownSight(const OccupancyMap& map, const BrickSet& wanted, const UnknownSightOptions& options);

  /// The wanted cells that a view may observe, in raster order. Cells whose centre is closer than the sensor's
  /// minimum range are passed but not returned. `caster` must show the same map in the same state. Adds the number of
  /// cells on the rays to `operations`. Errors as RayCaster::cast.
  [[nodiscard]] std::vector<SightedCell> look(const RayCaster& caster, const Pose& world_from_sensor,
                                              const ViewRays& rays, std::uint64_t& operations) const;

 private:
  enum class Content : std::uint8_t { Open, Wanted, WantedBesideSurface, Surface };
  struct Ray;
  class Reader;
  class Chances;
  void follow(const Ray& ray, Reader& content_of, Chances& chances) const;

  const OccupancyMap* map_;
  VoxelFrame frame_;
  UnknownSightOptions options_;
  VoxelBox bounds_;                             // of the known cells
  VoxelBox box_;                                // around the wanted cells
  BrickGrid<Content> contents_{Content::Open};  // of the bricks that hold wanted cells
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/unknown_sight.ipp>
#endif
