// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>
#include <vantage/raytrace/impl/tile_hits.hpp>

namespace vantage {

/// Follows the rays of a tile to the first cells that stop them. The rays of a class go as one beam through free
/// layers, and as lanes (SliceLanes) through slices where a cell may stop them. Single rays are walked exactly
/// (SingleWalk) if they spread too far, end there, or pass too close to an edge between cells. The resulting cells
/// equal those of VoxelRay for every instruction set. (Glossary in view_walk.hpp.)
class TileWalk {
 public:
  TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin, InstructionSet set);

  /// Walks the selected `rays` of a block. They start at the origin, and their ends must be placed. Hits outside
  /// `within` may be missing. No cell may stop a ray within the first `free_share` of its length, in [0, 1].
  void walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, double free_share, HitSink& hits);

 private:
  /// The lateral cells in which rays may be; both bounds included.
  struct Window {
    std::array<std::int32_t, 2> lo;
    std::array<std::int32_t, 2> hi;
  };
  /// The range of slopes: lateral cells per cell along the major axis.
  struct Spread {
    std::array<double, 2> least;
    std::array<double, 2> most;
  };

  void measure(const RayBlock& block);
  [[nodiscard]] std::uint64_t take_class(std::uint64_t rays);
  void walk_class(std::uint64_t rays, HitSink& hits);
  void follow(std::uint64_t active, std::int64_t slice, HitSink& hits);
  bool cross(std::uint64_t& active, std::int64_t slice, HitSink& hits);
  void end_rays(std::uint64_t ending, std::int64_t slice, SliceHits& of_slices) const;
  void walk_singly(const RayBlock& block, std::uint64_t rays, HitSink& hits) const;
  [[nodiscard]] std::int64_t last_slice() const;
  [[nodiscard]] std::uint64_t ending_by(double distance) const;
  [[nodiscard]] double entered_at(std::int64_t slice) const;
  [[nodiscard]] Spread spread_of(std::uint64_t active) const;
  [[nodiscard]] Window window_of(const Spread& spread, std::int64_t first, std::int64_t last) const;
  [[nodiscard]] std::int32_t free_layers(const Window& words, std::int32_t along);
  bool fill_windows(const Window& window, std::int64_t slice, std::size_t count);
  void place_lanes(double enters, double through);

  const BlockingGrid& grid_;
  BlockingGrid::Reader reader_;
  VoxelFrame frame_;
  InstructionSet set_;
  Eigen::Vector3d origin_;
  VoxelIndex first_;
  std::array<std::int32_t, 3> first_cell_;  // same as first_
  std::array<double, 3> within_first_;      // position of the origin in its cell, in [0, 1]
  VoxelBox within_;

  double free_share_ = 0.0;

  // State of the class that is being walked.
  SlicePlace place_;          // axes of the class, and the current windows
  double from_entry_ = 0.0;   // distance from the face through which rays would enter slice 0 to the origin, in cells
  double nearest_end_ = 0.0;  // shortest length of a ray along the major axis, in cells
  double furthest_end_ = 0.0;
  std::uint64_t singly_ = 0;  // rays that need an exact walk

  SliceLanes lanes_;
  SliceWindows windows_;
  alignas(64) std::array<RayBlock::PerRay<double>, 3> extent_{};  // lengths of the rays per axis, in cells
  // slopes: lateral cells per cell along the major axis
  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope_{};
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/tile_walk.ipp>
#endif
