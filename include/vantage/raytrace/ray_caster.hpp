// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace VANTAGE_EXPORT vantage {

namespace detail {
class BlockingGrid;
}

/// The cell in which a ray ends.
struct RayEnd {
  VoxelIndex cell;  ///< the first cell that is not free; the last cell of the ray if all are free
  Occupancy occupancy = Occupancy::Unknown;  ///< state of that cell

  /// Whether cell and state are equal.
  friend bool operator==(const RayEnd&, const RayEnd&) = default;
};

/// Reference implementation of ray casting: returns the first cell on the segment from `from` to `to` that is not
/// free. It visits every cell on an exact walk (VoxelRay) and is slow; RayCaster is tested against it. Both points
/// are in the world frame, metres, and must be addressable in `frame`. (Amanatides & Woo 1987.)
template <OccupancyLookup Lookup>
[[nodiscard]] RayEnd first_not_free(const Lookup& map, const VoxelFrame& frame, const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to);

/// Whether nothing stands between a point and the centre of a cell: all cells of the line are free; the target
/// itself may be in any state. World frame, metres; both ends must be addressable in `frame`. Starts at the
/// target, because most blocked lines are blocked near it, and adds the number of tested cells to `operations`.
template <OccupancyLookup Lookup>
[[nodiscard]] bool in_plain_sight(const Lookup& map, const VoxelFrame& frame, const Eigen::Vector3d& from,
                                  const VoxelIndex& target, std::uint64_t& operations) {
  return VoxelRay(frame, from, frame.centre_of(target)).all_from_the_end([&](const VoxelIndex& cell) {
    ++operations;
    return cell == target || map.at(cell) == Occupancy::Free;
  });
}

/// Cell size of a RayCaster, and the rule for the state of its cells.
struct RayCasterOptions {
  /// Cells have an edge of 2^level finest cells of the map; level in [0, 16]. This is depth 16 - level in an OctoMap.
  int level = 0;
  /// How the state of a coarse cell is computed from the finest cells inside it.
  CoarseningPolicy policy = CoarseningPolicy::Max;
};

/// Finds, for each ray, the first cell that is not known free: occupied or unknown. This is what a sensor would see.
///
///     RayCaster caster(map);
///     const RayEnd end = caster.cast(from, to);
///     map.insert(scan);
///     caster.update();  // cost depends on what has changed
///
/// The result equals that of `first_not_free`. It is fast because the caster keeps a copy of the map with one bit per
/// cell, and for every 4 x 4 x 4 cells the distance to the next cell that stops a ray, so that rays skip free space.
/// The map must outlive the caster. Concurrent casts are safe while nobody updates.
class RayCaster {
 public:
  /// Copies the current state of the map. Throws std::invalid_argument, which names the invalid option, and
  /// std::length_error if the known cells are too far apart (2^42 cells in their bounding box).
  explicit RayCaster(const OccupancyMap& map, const RayCasterOptions& options = RayCasterOptions{});
  ~RayCaster();
  /// Takes over `other`, which may then only be assigned to or destroyed.
  RayCaster(RayCaster&&) noexcept;
  /// Takes over `other`, which may then only be assigned to or destroyed.
  RayCaster& operator=(RayCaster&&) noexcept;
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Applies the changes of the map since the last call or the construction. The cost depends on the changes, except
  /// for coarse cells with CoarseningPolicy::Mean, which are all recomputed. Returns the number of bricks that were
  /// read. Errors as the constructor.
  std::size_t update();

  /// Assumes the content of unknown cells. Inside the box of `stopping`, only occupied cells and the cells of
  /// `stopping` stop rays; the latter must be unknown. The assumption about a cell holds until `update` reads a
  /// change of its brick, or until the next call for the same box. Throws std::length_error as the constructor.
  void suppose(const CellSet& stopping);

  /// The frame of the caster's cells, which have the size of its level.
  [[nodiscard]] const VoxelFrame& frame() const { return frame_; }
  /// The options that were passed to the constructor.
  [[nodiscard]] const RayCasterOptions& options() const { return options_; }
  /// State of a cell at the last update. An unknown cell that is assumed not to stop rays counts as free.
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const;
  /// Memory in use, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Casts one ray between two points in the world frame, metres. Throws std::invalid_argument if a point is not
  /// finite or not addressable.
  [[nodiscard]] RayEnd cast(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  /// Casts all rays of a view and writes their ends to `ends`, in image order. A ray reaches as far as a ray of
  /// Scan::no_return, so it passes exactly the cells that such a scan would clear. Throws std::invalid_argument if
  /// the pose is not rigid, a ray is not addressable, or `ends` has the wrong size.
  void cast(const Pose& world_from_sensor, const ViewRays& rays, std::span<RayEnd> ends) const;

  /// The distinct cells of `box` that a view sees: the cells, not free, in which a ray ends. Cells whose centre is
  /// closer than the sensor's minimum range stop rays but are not seen. Throws std::invalid_argument if the pose is
  /// not rigid or a ray is not addressable. (Vasquez-Gomez et al. 2013, IV-A.)
  [[nodiscard]] CellSet visible_cells(const Pose& world_from_sensor, const ViewRays& rays, const VoxelBox& box) const;
  /// The number of cells of a set that are in this state.
  [[nodiscard]] std::size_t count(const CellSet& cells, Occupancy occupancy) const;

 private:
  const OccupancyMap* map_;
  RayCasterOptions options_;
  VoxelFrame frame_;
  std::unique_ptr<detail::BlockingGrid> grid_;
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

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/ray_caster.ipp>
#endif
