// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/single_walk.hpp>
#include <vantage/raytrace/impl/slices.hpp>

namespace vantage::detail {

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

inline TileWalk::TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin,
                          InstructionSet set)
    : grid_(grid), frame_(frame), set_(set), origin_(origin), slices_(grid, set), walk_(set) {
  for (std::int32_t number = 0; SliceBeam & of_class : beams_) {
    of_class = SliceBeam(frame, origin, number++);
  }
}

inline void TileWalk::walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, double free_share,
                           HitSink& hits) {
  RayExtents extents;
  measure(block, origin_, frame_.size_m, extents, set_);
  const RayBlock::PerRay<std::int32_t> classes = classes_of(extents);
  std::uint64_t singly = 0;  // rays that need an exact walk
  while (rays != 0) {
    const std::int32_t chosen = classes[static_cast<std::size_t>(std::countr_zero(rays))];
    const std::uint64_t of_class = equal_to(classes, chosen, set_) & rays;
    rays &= ~of_class;
    singly |= std::popcount(of_class) < SliceWalk::kFewRays
                  ? of_class
                  : walk_class(beams_[static_cast<std::size_t>(chosen)], extents, of_class, within, free_share, hits);
  }
  for (; singly != 0; singly &= singly - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(singly));
    const Eigen::Vector3d end(block.end[0][i], block.end[1][i], block.end[2][i]);
    SingleWalk walk(frame_, origin_, frame_.cell_of(origin_), end, frame_.cell_of(end));
    if (walk.advance(grid_)) {
      hits.take(i, walk.cell());
    }
  }
}

inline RayBlock::PerRay<std::int32_t> TileWalk::classes_of(const RayExtents& extents) const {
  RayBlock::PerRay<std::int32_t> classes;
  compiled_for(set_, [x = extents[0].data(), y = extents[1].data(), z = extents[2].data(), of = classes.data()] {
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      of[i] = class_of_ray(x[i], y[i], z[i]);
    }
  });
  return classes;
}

// Walks the rays of a class. Returns those that need an exact walk.
inline std::uint64_t TileWalk::walk_class(SliceBeam beam, const RayExtents& extents, std::uint64_t rays,
                                          const VoxelBox& within, double free_share, HitSink& hits) {
  walk_.lines.place(extents, beam.axes, set_);
  const auto [shortest, longest] = range_of(walk_.lines.length, rays, set_);
  // A ray without a length has no slopes.
  if (!(shortest > SliceBeam::kRounding)) {
    return rays;
  }
  walk_.shortest = shortest;
  beam.tighten(walk_.lines, rays, set_);
  // The last slice in which a ray may meet a cell of interest.
  slices_.begin(std::min(beam.last_slice_of(within),
                         static_cast<std::int64_t>(longest + beam.from_entry + SliceBeam::kRounding)));
  const double free_cells = free_share * shortest - SliceBeam::kRounding;
  const auto first = free_cells > 0.0 ? static_cast<std::int64_t>(std::max(free_cells + beam.from_entry, 0.0)) : 0;
  return walk_.follow(slices_, beam, rays, slices_.next_stop(beam, first), hits);
}

}  // namespace vantage::detail
