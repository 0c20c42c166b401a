// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <raytrace/slice_beam.hpp>
#include <raytrace/slice_lanes.hpp>
#include <raytrace/tile_hits.hpp>
#include <vantage/geometry/voxel.hpp>

namespace vantage {

/// Follows all rays that may be in a beam through slices at once, whichever they are: not where each of them is, but
/// in which cells there may be one. A ray of the beam meets no cell but those that it says may be met.
///
/// In a slice, a ray crosses at most one face across each lateral axis, in the direction in which it goes. So from
/// the cells in which rays enter the slice they may come, if those do not stop them, to the next along the one axis,
/// the other, or one after the other, as far as the beam is wide; and of those that do not stop them they enter the
/// next slice. What stops rays hides what is behind it.
class SliceFlood {
 public:
  /// Of beams that are to meet cells of `box`.
  SliceFlood(const VoxelBox& box, InstructionSet set) : box_(box), set_(set) {}

  /// Turns to a beam. False: its rays go so far askew that nothing is certain.
  [[nodiscard]] bool begin(const SliceBeam& beam);
  /// Follows the rays through the slices of windows that hold them there, from the slice `first` on; no cell has
  /// stopped any since the last ones. `met` gets the cells of the box that they may meet. Returns
  /// whether there may be rays that are not stopped.
  [[nodiscard]] bool pass(const SliceWindows& windows, const SlicePlace& place, std::int64_t first, WindowCells& met);

 private:
  void move(std::int64_t first, const SlicePlace& place);

  VoxelBox box_;
  InstructionSet set_;
  SliceBeam beam_;
  bool is_full_ = true;       // rays may be anywhere in the beam
  std::int64_t slice_ = 0;    // which they enter next
  std::int32_t first_u_ = 0;  // where cells_ lie
  std::int32_t first_v_ = 0;
  alignas(64) WindowRows cells_{};  // in which they do
};

}  // namespace vantage
