// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map/instruction_set.hpp>
#include <map/ray_block.hpp>

namespace vantage {

/// Up to four slices of cells, one cell thick each, across the axis along which rays advance fastest: for every slice
/// a window of 32 x 16 cells in which a bit says that the cell stops a ray.
struct SliceWindows {
  static constexpr std::int32_t kWidth = 32;   ///< cells along the first lateral axis
  static constexpr std::int32_t kHeight = 16;  ///< cells along the second
  static constexpr std::size_t kMost = 4;      ///< slices

  alignas(64) std::array<std::array<std::uint32_t, kHeight>, kMost> rows{};  ///< by slice, then second axis
  std::size_t count = 0;                                                     ///< slices, in the order of the walk
};

/// Cells of such a window, and of all the slices.
using WindowRows = std::array<std::uint32_t, SliceWindows::kHeight>;
using WindowCells = std::array<WindowRows, SliceWindows::kMost>;

/// 64 rays from one origin that walk through slices of cells together.
///
/// A ray advances fastest along the major axis, so it crosses at most one face across each of the two lateral axes
/// while it is in one slice: there are at most three cells to look at, and no branches. Places are fixed-point
/// numbers in the window, so that 16 rays fit a register; where a ray passes too near an edge between cells for them
/// to say which cells it passes, it is said to be doubtful, and VoxelRay is to decide.
struct SliceLanes {
  static constexpr unsigned kBits = 25;                       ///< after the point
  static constexpr std::int32_t kCell = 1 << kBits;           ///< the width of a cell
  static constexpr std::int32_t kDoubt = 1 << (kBits - 19U);  ///< places may be as wrong as this: 2e-6 cells

  alignas(64) RayBlock::PerRay<std::int32_t> u{};       ///< where rays enter the first slice, first lateral axis
  alignas(64) RayBlock::PerRay<std::int32_t> v{};       ///< and second
  alignas(64) RayBlock::PerRay<std::int32_t> step_u{};  ///< how far they go on their way through a slice,
  alignas(64) RayBlock::PerRay<std::int32_t> step_v{};  ///< at most a cell
};

/// What became of rays in a few slices.
struct SliceHits {
  std::uint64_t stopped = 0;   ///< a bit for each ray that met a cell that stops it
  std::uint64_t doubtful = 0;  ///< a bit for each of which that is not certain
  /// Of a stopped ray: column in the window of the cell that stops it + 32 * row + 512 * number of the slice.
  alignas(64) RayBlock::PerRay<std::int32_t> where{};
};

/// Walks the `active` rays through the slices, wherever they end. While they are in a slice they must be in its
/// window.
void walk_slices(const SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active, SliceHits& hits,
                 InstructionSet set);

}  // namespace vantage
