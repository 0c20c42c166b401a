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

/// What is left to be seen of the surface of an object, and what a view is expected to see of it.
///
/// The surface is that of occupied cells and of unknown cells that are supposed to be occupied; its elements are the
/// faces of those cells, for a cell may hold a wall of which one side has been seen and the other has not. A view has
/// looked at a face if a ray of it ends in the cell and the sensor was on the side of the face.
///
/// Unknown cells that a scan has passed, or has not resolved, are taken for free from then on: a ray that meets
/// nothing tells so even where its sensor does not report it. Of the others, one is supposed to be occupied with the
/// chance that a known cell of the object's box is, higher beside known surface; which ones is drawn, for every cell
/// once and for all.
class UnseenSurface {
 public:
  /// A face of a cell, by number: the cell's place in the box times six and the place of the step in kFaceNeighbours.
  using Face = std::uint32_t;

  /// For the object in this box. Throws std::length_error if the box has too many cells to number their faces.
  UnseenSurface(const OccupancyMap& map, const VoxelBox& object);

  /// Takes the map as it is after a scan from this pose.
  void look(const OccupancyMap& map, const Pose& world_from_sensor, const ViewRays& rays);
  /// The faces that a view is expected to be the first to look at, ascending. Errors as RayCaster::visible_cells.
  [[nodiscard]] std::vector<Face> expected(const Pose& world_from_sensor, const ViewRays& rays) const;
  /// Those of all faces that nothing has looked at yet before which a ray may pass.
  [[nodiscard]] std::vector<CellFace> left() const;
  /// How many faces have been looked at.
  [[nodiscard]] std::size_t looked_at() const;
  /// In the map with what is supposed of it.
  [[nodiscard]] const RayCaster& caster() const { return caster_; }
  /// The cell of a face.
  [[nodiscard]] VoxelIndex cell_of(Face face) const { return looked_.cell_at(face / 6); }

 private:
  [[nodiscard]] bool stops(const VoxelIndex& cell) const { return caster_.at(cell) != Occupancy::Free; }
  void pass_rays(const OccupancyMap& map, const Pose& world_from_sensor, const ViewRays& rays);
  void suppose(const OccupancyMap& map);

  VoxelFrame frame_;
  RayCaster caster_;
  VoxelGrid<std::uint8_t> looked_;  // a bit for every face, and one for cells taken for free
};

}  // namespace vantage
