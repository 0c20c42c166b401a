// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <raytrace/blocking_grid.hpp>
#include <raytrace/slice_lanes.hpp>

namespace vantage {

/// Where rays were stopped.
struct TileHits {
  std::uint64_t stopped = 0;                             ///< a bit for each ray that was
  std::array<RayBlock::PerRay<std::int32_t>, 3> cell{};  ///< by which cell
};

/// Follows neighbouring rays from one origin to the first cells that stop them: together as one beam while all that
/// it may pass is free, then in slices (SliceLanes), and one by one where they lie too far apart for that. The cells
/// are those of VoxelRay, whatever the instruction set.
class TileWalk {
 public:
  TileWalk(const BlockingGrid& grid, const VoxelFrame& frame, const Eigen::Vector3d& origin, InstructionSet set);

  /// Walks `rays` of a block, which start at the origin. They may be left where they can no longer meet a cell of
  /// `within`: what they meet behind is not told.
  void walk(const RayBlock& block, std::uint64_t rays, const VoxelBox& within, TileHits& hits);

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

  void time_faces(const RayBlock& block, std::uint64_t rays);
  [[nodiscard]] std::uint64_t take_class(std::uint64_t rays, const RayBlock& block);
  void walk_class(const RayBlock& block, std::uint64_t rays, TileHits& hits);
  void follow(const RayBlock& block, std::uint64_t active, std::int64_t slice, TileHits& hits);
  void walk_singly(const RayBlock& block, std::uint64_t rays, TileHits& hits) const;
  [[nodiscard]] std::int64_t last_slice(const RayBlock& block, std::uint64_t rays) const;
  [[nodiscard]] Spread spread_of(std::uint64_t active) const;
  [[nodiscard]] Window window_of(const Spread& spread, std::int64_t first, std::int64_t last) const;
  [[nodiscard]] VoxelIndex word_at(std::int32_t along, std::int32_t u, std::int32_t v) const {
    return lanes_.major == 0   ? VoxelIndex{along, u, v}
           : lanes_.major == 1 ? VoxelIndex{u, along, v}
                               : VoxelIndex{u, v, along};
  }
  [[nodiscard]] std::int32_t free_layers(const Window& words, std::int32_t along) const;
  bool fill_windows(const Window& window, std::int64_t slice, std::size_t count);
  void take_hits(const SliceHits& of_slices, std::int64_t slice, TileHits& hits) const;

  const BlockingGrid& grid_;
  VoxelFrame frame_;
  InstructionSet set_;
  Eigen::Vector3d origin_;
  VoxelIndex first_;
  std::array<std::int32_t, 3> first_cell_;  // the same
  std::array<double, 3> within_first_;      // place of the origin in its cell, in [0, 1]
  VoxelBox within_;

  SliceLanes lanes_;
  SliceWindows windows_;
  std::array<std::int32_t, 2> window_cell_{};                       // first cell of the windows, laterally
  bool advances_ = true;                                            // the rays leave their first cell
  bool up_ = true;                                                  // along the major axis
  alignas(64) std::array<RayBlock::PerRay<double>, 3> extent_m_{};  // of rays
  alignas(64) std::array<RayBlock::PerRay<double>, 2> slope_{};     // lateral cells per cell along the major axis
};

}  // namespace vantage
