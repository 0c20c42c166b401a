// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vantage/raytrace/impl/slices.hpp>

namespace vantage {

/// Follows the rays of a tile to the first cells that stop them, class by class (SliceWalk). Single rays are walked
/// exactly (SingleWalk) if they spread too far, or pass too close to an edge between cells. The resulting cells equal
/// those of VoxelRay for every instruction set.
class TileWalk {
 public:
  TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin, InstructionSet set);

  /// Walks the selected `rays` of a block. They start at the origin, and their ends must be placed. Hits outside
  /// `within` may be missing. No cell may stop a ray within the first `free_share` of its length, in [0, 1].
  void walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, double free_share, HitSink& hits);

 private:
  [[nodiscard]] RayBlock::PerRay<std::int32_t> classes_of(const RayExtents& extents) const;
  [[nodiscard]] std::uint64_t walk_class(SliceBeam beam, const RayExtents& extents, std::uint64_t rays,
                                         const VoxelBox& within, double free_share, HitSink& hits);

  const BlockingGrid& grid_;
  VoxelFrame frame_;
  InstructionSet set_;
  Eigen::Vector3d origin_;
  std::array<SliceBeam, 6> beams_;  // all rays of each class
  GridSlices slices_;
  SliceWalk walk_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/tile_walk.ipp>
#endif
