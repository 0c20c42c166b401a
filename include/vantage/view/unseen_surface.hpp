// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
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
/// The surface consists of the faces of occupied cells, and of unknown cells that are assumed to be occupied. Faces
/// are used instead of cells, because a cell may contain a wall that was seen from one side only. A view has observed
/// a face if a ray ends in the cell and the sensor was on the side of the face.
///
/// Unknown cells that a scan has passed or failed to resolve are treated as free from then on, even if the sensor
/// does not report missing returns. Each other unknown cell is assumed to be occupied with a probability: that of
/// known cells in the object's box, or a higher one beside known surface. The random decision for a cell never
/// changes.
class UnseenSurface {
 public:
  /// Number of a face: 6 times the index of the cell in the box, plus the index of the step across the face in
  /// kFaceNeighbours.
  using Face = std::uint32_t;

  /// Tracks the object in the box `object`. `map` must outlive this object. Throws std::length_error if the box has
  /// too many cells to number their faces.
  UnseenSurface(const OccupancyMap& map, const VoxelBox& object);

  /// Updates the state from the map after a scan from this pose (world_from_sensor). `map` must be the map of the
  /// constructor.
  void look(const OccupancyMap& map, const Pose& world_from_sensor, const ViewRays& rays);
  /// The faces that a view would be the first to observe, ascending. Errors as RayCaster::visible_cells.
  [[nodiscard]] std::vector<Face> expected(const Pose& world_from_sensor, const ViewRays& rays) const;
  /// All faces of the surface that were not observed yet and that a ray can reach from the adjacent cell.
  [[nodiscard]] std::vector<CellFace> left() const;
  /// The number of observed faces of occupied cells, without those whose adjacent cell blocks sight.
  [[nodiscard]] std::size_t looked_at() const;
  /// Shows the map together with the assumptions about unknown cells.
  [[nodiscard]] const RayCaster& caster() const { return caster_; }
  /// The cell of a face.
  [[nodiscard]] VoxelIndex cell_of(Face face) const { return looked_.cell_at(face / 6); }

 private:
  [[nodiscard]] bool stops(const VoxelIndex& cell) const { return caster_.at(cell) != Occupancy::Free; }
  void pass_rays(const OccupancyMap& map, const Pose& world_from_sensor, const ViewRays& rays);
  void suppose(const OccupancyMap& map);

  VoxelFrame frame_;
  VoxelGrid<std::uint8_t> looked_;  // bits 0-5: face observed; bit 6: cell treated as free
  RayCaster caster_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/unseen_surface.ipp>
#endif
