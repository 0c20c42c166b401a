// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <raytrace/blocking_grid.hpp>
#include <raytrace/slice_lanes.hpp>
#include <raytrace/tile_hits.hpp>

namespace vantage {

/// Follows neighbouring rays from one origin to the first cells that stop them: together as one beam while all that
/// it may pass is free, then in slices (SliceLanes), and one by one where they lie too far apart for that, where they
/// end, or where they pass too near an edge between cells. The cells are those of VoxelRay, whatever the instruction
/// set.
class TileWalk {
 public:
  TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin, InstructionSet set);

  /// Walks `rays` of a block, of which the ends are placed and which start at the origin. They may be left where they
  /// can no longer meet a cell of `within`: what they meet behind is not told. Nothing stops them in the first
  /// `free_share` of their way, of which 1 is all.
  void walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, double free_share, HitSink& hits);

 private:
  /// Lateral cells that rays may be in, first and last.
  struct Window {
    std::array<std::int32_t, 2> lo;
    std::array<std::int32_t, 2> hi;
  };
  /// Least and largest lateral cells per cell along the major axis.
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
  std::array<std::int32_t, 3> first_cell_;  // the same
  std::array<double, 3> within_first_;      // place of the origin in its cell, in [0, 1]
  VoxelBox within_;

  double free_share_ = 0.0;

  // Of the class of rays that is being walked.
  SlicePlace place_;          // major axis: along which they advance fastest
  double from_entry_ = 0.0;   // of the origin, to where it would have entered its slice, in cells
  double nearest_end_ = 0.0;  // of rays, along the major axis
  double furthest_end_ = 0.0;
  std::uint64_t singly_ = 0;  // rays that only a walk of their own can tell of

  SliceLanes lanes_;
  SliceWindows windows_;
  alignas(64) std::array<RayBlock::PerRay<double>, 3> extent_{};  // of rays, in cells
  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope_{};   // lateral cells per cell along the major axis
};

}  // namespace vantage
