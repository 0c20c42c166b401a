// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vantage/view/aimed_views.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Tracks which parts of an object's surface were observed, and predicts what a view would observe of the rest.
///
/// How the surface lies in a cell is not known, so every occupied cell, and every unknown cell that is assumed to be
/// occupied, has 26 sides: the directions of its neighbours, of which those towards a cell that lets rays pass may be
/// the normal of a surface. A view has observed a side if a ray ends in the cell and the sensor was on that side, at
/// an incidence under 85 degrees. In a plane, where a cell has 8 sides:
///
///                  seen   seen   seen
///                      \   |   /
///     sensor        seen --[cell]-- not seen      a surface across an edge of the silhouette is left for
///     below left       /   |   \                  another view, however thin the object is
///                  seen   seen   not seen
///
/// A step of the grid shows sides that are no normals. So a side counts only if it is open: no cell that the adjacent
/// cell touches beside it stops rays. And a side of an occupied cell is looked for only in a row: at least two of its
/// occupied neighbours, or half of them if there are few, have an open side that was not observed either, at most 55
/// degrees apart.
///
/// Directions across a face weigh 4, across an edge 2, across a corner 1: the binomial kernel of a normal that is
/// estimated from neighbours.
///
/// Unknown cells that a scan has passed or failed to resolve are treated as free from then on, even if the sensor
/// does not report missing returns. Each other unknown cell is assumed to be occupied with such a probability that a
/// ray through a box of unknown cells would meet one surface on average. The random decision for a cell never
/// changes.
class UnseenSurface {
 public:
  /// Number of a side: 26 times the index of the cell in the box, plus the index of the direction in kAllNeighbours.
  using Side = std::uint32_t;

  /// Tracks the object in the box `object`. `map` must outlive this object. Throws std::length_error if the box has
  /// too many cells to number their sides.
  UnseenSurface(const OccupancyMap& map, const VoxelBox& object);

  /// Updates the state from the map after a scan from this pose (world_from_sensor). `map` must be the map of the
  /// constructor.
  void look(const OccupancyMap& map, const Pose& world_from_sensor, const ViewRays& rays);
  /// The sides that a view would be the first to observe, ascending. Errors as RayCaster::visible_cells.
  [[nodiscard]] std::vector<Side> expected(const Pose& world_from_sensor, const ViewRays& rays) const;
  /// All sides of the surface to look for: open ones that were not observed yet, in rows.
  [[nodiscard]] std::vector<CellSide> left() const;
  /// The weight of all observed open sides of occupied cells.
  [[nodiscard]] std::size_t looked_at() const;
  /// The sum of the weights of sides.
  [[nodiscard]] static std::size_t weight_of(std::span<const Side> sides);
  /// Casts rays through the map together with the assumptions about unknown cells.
  [[nodiscard]] const RayCaster& caster() const { return caster_; }
  /// The cell of a side.
  [[nodiscard]] VoxelIndex cell_of(Side side) const { return looked_.cell_at(side / kAllNeighbours.size()); }
  /// The step from the cell of a side to the adjacent cell.
  [[nodiscard]] static VoxelIndex towards(Side side) { return kAllNeighbours[side % kAllNeighbours.size()]; }

 private:
  [[nodiscard]] bool stops(const VoxelIndex& cell) const { return caster_.at(cell) != Occupancy::Free; }
  // Whether rays can pass through the adjacent cell and, across an edge or a corner, through the cells beside both.
  [[nodiscard]] bool open_towards(const VoxelIndex& cell, std::uint32_t side) const;
  // Finds the sides to look for.
  void find_unseen();
  // Those of the open sides of an occupied cell that are in a row; `open`: by cell.
  [[nodiscard]] std::uint32_t in_rows(const VoxelIndex& cell, const VoxelGrid<std::uint32_t>& open) const;
  void pass_rays(const OccupancyMap& map, const Pose& world_from_sensor, const ViewRays& rays);
  void suppose(const OccupancyMap& map, double chance);

  VoxelFrame frame_;
  VoxelGrid<std::uint32_t> looked_;  // bits 0-25: side observed; bit 26: cell treated as free
  VoxelGrid<std::uint32_t> unseen_;  // bits 0-25: side to look for
  RayCaster caster_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/unseen_surface.ipp>
#endif
