// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map/instruction_set.hpp>
#include <map/ray_block.hpp>
#include <utility>

namespace vantage {

/// Up to four slices of cells, one cell thick each, across the axis along which rays advance fastest: for every slice
/// a window of 32 x 16 cells in which a bit says that the cell stops a ray.
struct SliceWindows {
  static constexpr std::int32_t kWidth = 32;   ///< cells along the first lateral axis
  static constexpr std::int32_t kHeight = 16;  ///< cells along the second
  static constexpr std::size_t kMost = 4;      ///< slices

  alignas(64) std::array<std::array<std::uint32_t, kHeight>, kMost> rows{};  ///< by slice, then second axis
  std::size_t count = 0;                                                     ///< slices, in the order of the walk
  std::int64_t origin = 0;  ///< lateral position (SliceLanes::at) of the first cell of the windows
};

/// 64 rays from one origin that walk through slices of cells together: the traversal of VoxelRay, slice by slice.
///
/// A ray advances fastest along the major axis, so it crosses at most one face across each of the two lateral axes
/// while it is in one slice: there are at most three cells to look at, and no branches.
struct SliceLanes {
  template <class T>
  using PerRay = RayBlock::PerRay<T>;

  alignas(64) std::array<PerRay<std::int64_t>, 3> next{};   ///< time of the next face crossed, per axis of the world
  alignas(64) std::array<PerRay<std::int64_t>, 3> delta{};  ///< time from face to face, 0: none is crossed
  alignas(64) PerRay<std::int64_t> at{};      ///< lateral cells from the origin's: first + 32 * second axis
  alignas(64) PerRay<std::int64_t> step_u{};  ///< what a face across the first lateral axis adds to it, +-1
  alignas(64) PerRay<std::int64_t> step_v{};  ///< what one across the second adds, +-32
  std::size_t major = 0;                      ///< axis across which slices lie
  std::size_t u = 1;                          ///< first lateral axis
  std::size_t v = 2;                          ///< second lateral axis, > u

  /// Chooses the axis of slices.
  void set_major(std::size_t axis) {
    major = axis;
    u = axis == 0 ? 1 : 0;
    v = axis == 2 ? 1 : 2;
  }
};

/// What became of rays in a few slices.
struct SliceHits {
  std::uint64_t stopped = 0;                            ///< a bit for each ray that met a cell that stops it
  std::uint64_t ended = 0;                              ///< a bit for each ray that came to its end before
  alignas(64) RayBlock::PerRay<std::int64_t> slice{};   ///< of a stopped ray: number of the slice
  alignas(64) RayBlock::PerRay<std::int64_t> within{};  ///< and the position in its window
};

/// The rays with this value, a bit for each.
[[nodiscard]] std::uint64_t equal_to(const RayBlock::PerRay<std::int64_t>& values, std::int64_t value,
                                     InstructionSet set);

/// The least and the largest of the values of the `active` rays.
[[nodiscard]] std::pair<double, double> range_of(const RayBlock::PerRay<double>& values, std::uint64_t active,
                                                 InstructionSet set);

/// Walks the `active` rays, all at the beginning of the first slice, through the slices. While they are in a slice
/// they must be in its window. Where rays are that are not active is undefined afterwards.
void walk_slices(SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active, SliceHits& hits,
                 InstructionSet set);

/// Moves the `active` rays from the beginning of a slice to that of the `slices`-th after it, all at once, whatever
/// is in the cells between. Returns the rays that came to their end before.
[[nodiscard]] std::uint64_t skip_slices(SliceLanes& lanes, std::int64_t slices, std::uint64_t active,
                                        InstructionSet set);

}  // namespace vantage
