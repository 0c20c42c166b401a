// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/ray_block.hpp>
#include <vantage/raytrace/impl/slice_windows.hpp>

namespace vantage::detail {

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

  /// The parts of `where`.
  [[nodiscard]] static constexpr std::int32_t column(std::int32_t where) { return where & 31; }
  [[nodiscard]] static constexpr std::int32_t row(std::int32_t where) { return where >> 5 & 15; }
  [[nodiscard]] static constexpr std::int32_t slice(std::int32_t where) { return where >> 9; }
};

/// Walks the `active` rays through all slices; the ends of the rays are ignored. The rays must be inside the window
/// of each slice. `hits.where` changes only for stopped rays.
void walk_slices(const SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active, SliceHits& hits,
                 InstructionSet set);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/slice_lanes.ipp>
#endif
