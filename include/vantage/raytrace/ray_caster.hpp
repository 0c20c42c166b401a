// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace VANTAGE_EXPORT vantage {

/// Where a ray comes to its end.
struct RayEnd {
  VoxelIndex cell;  ///< the first cell that is not free; if all are free, the last of the ray
  Occupancy occupancy = Occupancy::Unknown;  ///< state of that cell

  /// The same cell in the same state.
  friend bool operator==(const RayEnd&, const RayEnd&) = default;
};

/// The definition of casting a ray: the first cell from that of `from` to that of `to` which is not free, on an exact
/// walk (Amanatides & Woo 1987, VoxelRay) that looks at every cell. Slow; it is what RayCaster is tested against.
/// Both points must be addressable in `frame`.
template <OccupancyLookup Lookup>
[[nodiscard]] RayEnd first_not_free(const Lookup& map, const VoxelFrame& frame, const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to);

/// How a RayCaster looks at its map.
struct RayCasterOptions {
  /// Cells are 2^level of the map's finest an edge, in [0, 16]; an OctoMap of depth 16 calls it depth 16 - level.
  int level = 0;
  /// How a coarser cell speaks for the finest ones in it.
  CoarseningPolicy policy = CoarseningPolicy::Max;
};

/// Finds the first cell along rays that is not known to be free, occupied or unknown: what a sensor would see there.
///
///     RayCaster caster(map);
///     const RayEnd end = caster.cast(from, to);
///     map.insert(scan);
///     caster.update();  // costs what changed
///
/// The cells are exactly those of `first_not_free`; what makes it fast is a copy of the map with a bit per cell and
/// the distance to the next cell that stops a ray for every 4 x 4 x 4 cells, over which rays leap. The map must
/// outlive the caster. Casting from several threads is safe while nobody updates.
class RayCaster {
 public:
  /// Takes the map as it is now. Throws std::invalid_argument naming the option at fault, std::length_error if the
  /// known cells are too far apart (2^42 cells in their bounding box).
  explicit RayCaster(const OccupancyMap& map, const RayCasterOptions& options = RayCasterOptions{});
  ~RayCaster();
  /// The caster moved from may only be assigned to or destroyed.
  RayCaster(RayCaster&&) noexcept;
  /// The caster moved from may only be assigned to or destroyed.
  RayCaster& operator=(RayCaster&&) noexcept;
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Follows the changes of the map since the last call, or since it was made. Costs what changed, but for means of
  /// coarser cells, which are all taken anew. Returns how many bricks were read. Errors as the constructor.
  std::size_t update();

  /// Supposes what unknown cells hold: in the box of the set rays are stopped by occupied cells and by those of the
  /// set alone, which must be unknown, and pass all others. This lasts until `update` finds a change of the map there
  /// or the next call for the same box.
  void suppose(const CellSet& stopping);

  /// The cells of which it speaks: those of the map at its level.
  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  /// The options it was made with.
  [[nodiscard]] const RayCasterOptions& options() const { return options_; }
  /// State of a cell at the last update.
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const;
  /// Bytes held.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Casts one ray. Throws std::invalid_argument if an end cannot be addressed.
  [[nodiscard]] RayEnd cast(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  /// Casts all rays of a view into `ends`, in the order of the image. A ray ends where a scan without returns would
  /// end (Scan::no_return), so it passes exactly the cells that such a scan would clear. Throws std::invalid_argument
  /// if the pose is not rigid, its rays cannot be addressed, or `ends` has another size.
  void cast(const Pose& world_from_sensor, const ViewRays& rays, std::span<RayEnd> ends) const;

  /// The cells of `box` that a view sees, each once: those in which a ray ends and that are not free (Vasquez-Gomez
  /// et al. 2013, IV-A). Cells whose centre is nearer than the sensor's minimum range stop rays but are not seen.
  /// Errors as `cast`.
  [[nodiscard]] CellSet visible_cells(const Pose& world_from_sensor, const ViewRays& rays, const VoxelBox& box) const;
  /// How many cells of a set are in this state.
  [[nodiscard]] std::size_t count(const CellSet& cells, Occupancy occupancy) const;

 private:
  struct Grid;

  const OccupancyMap* map_;
  RayCasterOptions options_;
  VoxelFrame frame_;
  std::unique_ptr<Grid> grid_;
};

template <OccupancyLookup Lookup>
RayEnd first_not_free(const Lookup& map, const VoxelFrame& frame, const Eigen::Vector3d& from,
                      const Eigen::Vector3d& to) {
  RayEnd end;
  for (const VoxelIndex& cell : VoxelRay(frame, from, to)) {
    end = {cell, map.at(cell)};
    if (end.occupancy != Occupancy::Free) {
      break;
    }
  }
  return end;
}

}  // namespace vantage
