// SPDX-License-Identifier: MIT
#pragma once

#include <map/ray_block.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/view_rays.hpp>

namespace vantage {

/// Puts the rays of one view into the world, tile by tile: each ends where a ray of a scan without a return ends.
class ViewPlacer {
 public:
  /// Throws std::invalid_argument if the pose is not rigid or rays cannot be addressed.
  ViewPlacer(const Pose& world_from_sensor, const ViewRays& rays, const VoxelFrame& frame);

  /// From the directions of a tile to the ends of its rays.
  void place_ends(const RayTile& tile, RayBlock& block) const {
    placer_.place_ends(tile.directions, tile.stretch, block);
  }
  /// From the ends of rays to their cells.
  void place_cells(RayBlock& block) const { placer_.place_cells(block); }

 private:
  RayPlacer placer_;
};

}  // namespace vantage
