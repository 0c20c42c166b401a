// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/map/impl/slice_beam.hpp>

namespace vantage {

/// Position of the windows of a few slices in the map.
struct SlicePlace : SliceAxes {
  std::int32_t along = 0;    ///< coordinate of the first slice along the major axis
  std::int32_t first_u = 0;  ///< coordinate of the first column of the windows, a multiple of 4
  std::int32_t first_v = 0;  ///< coordinate of the first row of the windows, a multiple of 4
};

/// Windows of up to four consecutive slices. A window is a part of a slice with 32 x 16 cells; a set bit is a cell
/// that stops rays.
struct SliceWindows {
  static constexpr std::int32_t kWidth = 32;   ///< cells along the first lateral axis, u
  static constexpr std::int32_t kHeight = 16;  ///< cells along the second lateral axis, v
  static constexpr std::size_t kMost = 4;      ///< maximum number of slices

  alignas(64) std::array<std::array<std::uint32_t, kHeight>, kMost> rows{};  ///< rows[slice][v], bit u
  std::size_t count = 0;   ///< number of slices, in the order of the walk
  std::int64_t first = 0;  ///< number of the first slice
  SlicePlace place;
};

/// A set of cells of one window, and of the windows of all slices.
using WindowRows = std::array<std::uint32_t, SliceWindows::kHeight>;
using WindowCells = std::array<WindowRows, SliceWindows::kMost>;

/// 64 rays from one origin that walk through slices together, one SIMD lane each.
///
/// A ray advances fastest along the major axis, so within a slice it crosses at most one face across each lateral
/// axis. At most three cells must be tested per slice, without branches. Positions are fixed-point numbers relative
/// to the window, so that 16 rays fit into a register. If a ray passes too close to an edge between cells for this
/// precision, it is marked doubtful, and an exact walk (SingleWalk) must decide.
struct SliceLanes {
  static constexpr unsigned kBits = 25;                       ///< fractional bits
  static constexpr std::int32_t kCell = 1 << kBits;           ///< width of a cell
  static constexpr std::int32_t kDoubt = 1 << (kBits - 19U);  ///< error bound of a position, 2e-6 cells

  alignas(64) RayBlock::PerRay<std::int32_t> u{};       ///< position along u where a ray enters the first slice
  alignas(64) RayBlock::PerRay<std::int32_t> v{};       ///< position along v
  alignas(64) RayBlock::PerRay<std::int32_t> step_u{};  ///< movement along u per slice, at most one cell
  alignas(64) RayBlock::PerRay<std::int32_t> step_v{};  ///< movement along v
};

/// Result of a walk through a few slices.
struct SliceHits {
  std::uint64_t stopped = 0;   ///< bit mask of the rays that met a cell that stops them
  std::uint64_t doubtful = 0;  ///< bit mask of the rays for which this is not certain
  /// For a stopped ray, its cell: column in the window + 32 * row + 512 * index of the slice.
  alignas(64) RayBlock::PerRay<std::int32_t> where{};
};

/// Walks the `active` rays through all slices; the ends of the rays are ignored. The rays must be inside the window
/// of each slice. `hits.where` changes only for stopped rays.
void walk_slices(const SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active, SliceHits& hits,
                 InstructionSet set);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/slice_lanes.ipp>
#endif
