// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/slice_walk.hpp>

namespace vantage {

/// The slices of a grid for a single tile: reads the words on the way of its beam when they are needed.
class GridSlices {
 public:
  /// The grid must outlive the object.
  GridSlices(const BlockingGrid& grid, InstructionSet set) : reader_(grid), set_(set) {}

  /// Starts a new walk up to slice `last`.
  void begin(std::int64_t last) { last_ = last; }
  /// The last slice.
  [[nodiscard]] std::int64_t last() const { return last_; }
  /// The first stop of a beam from this slice on.
  [[nodiscard]] Stop next_stop(const SliceBeam& beam, std::int64_t slice);
  /// Cuts the windows of a stop of this beam, which must be small enough (fits_windows). Keeps none if no cell of the
  /// stop stops a ray.
  void cut(const SliceBeam& beam, const Stop& stop, SliceWindows& windows);

 private:
  [[nodiscard]] std::int32_t free_layers(const SliceAxes& axes, const LateralCells& cells, std::int32_t along);

  BlockingGrid::Reader reader_;
  InstructionSet set_;
  std::int64_t last_ = 0;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/grid_slices.ipp>
#endif
