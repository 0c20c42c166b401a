// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>

namespace vantage::detail {

/// Flood (glossary in slices.hpp): follows a whole beam through slices as a set of cells, without looking at
/// single rays. The set is an upper bound: no ray of the beam meets a cell outside it.
///
/// In one slice, a ray crosses at most one face across each lateral axis, in the direction of its slope. From the
/// cell where it enters the slice it can reach the next cell along u, the next along v, or both, one after the other.
/// A step:
///
///     entered cells --> keep those that do not stop rays --> add the neighbours along u, along v, and along both
///     (cut off by the edges of the beam) --> those that do not stop rays enter the next slice
///
/// Cells that stop rays are recorded as met and hide what is behind them.
class SliceFlood {
 public:
  /// For beams that look for cells of `box`.
  SliceFlood(const VoxelBox& box, InstructionSet set) : box_(box), set_(set) {}

  /// Starts a new beam. Returns false if its slopes are too close to 1 for a certain result; the flood then must not
  /// be used.
  [[nodiscard]] bool begin(const SliceBeam& beam);
  /// Follows the beam through consecutive slices, given by windows that contain it. No cell may stop a ray between
  /// the last call and this one. `met` receives the cells of the box that rays may meet. Returns whether any ray may
  /// be left.
  [[nodiscard]] bool pass(const SliceWindows& windows, WindowCells& met);

 private:
  void move(const SliceWindows& windows);

  VoxelBox box_;
  InstructionSet set_;
  SliceBeam beam_;
  bool is_full_ = true;       // rays may be anywhere in the beam
  std::int64_t slice_ = 0;    // the slice that the rays enter next
  std::int32_t first_u_ = 0;  // window position of cells_
  std::int32_t first_v_ = 0;
  alignas(64) WindowRows cells_{};  // the cells in which rays may enter that slice
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/slice_flood.ipp>
#endif
