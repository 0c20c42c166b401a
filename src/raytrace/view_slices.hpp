// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <raytrace/blocking_grid.hpp>
#include <raytrace/slice_beam.hpp>
#include <raytrace/slice_lanes.hpp>
#include <vector>

namespace vantage {

/// The cells that stop rays of a view, slice by slice, wherever rays may be that meet its box: what the windows of
/// all tiles are cut from. A layer, four slices of words, is read when it is first asked for.
class ViewSlices {
 public:
  /// The grid must outlive it.
  ViewSlices(const BlockingGrid& grid, InstructionSet set) : reader_(grid), set_(set) {}

  /// From now on, of rays of this beam up to slice `last`. False: they lie too far apart, and there is nothing.
  bool begin(const SliceBeam& beam, std::int64_t last);

  /// How many layers, from that of this slice on, stop nothing.
  [[nodiscard]] std::int32_t free_layers(std::int64_t slice) { return layer_of(slice).free; }
  /// Whether all of these cells belong to the layer of this slice.
  [[nodiscard]] bool hold(std::int64_t slice, const LateralCells& cells) {
    const Layer& layer = layer_of(slice);
    return cells.lo[0] >= layer.first_u && cells.hi[0] < layer.end_u && cells.lo[1] >= layer.first_v &&
           cells.hi[1] < layer.end_v;
  }
  /// Some slices of a layer.
  struct Slices {
    std::int64_t first = 0;
    std::int64_t last = -1;
  };
  /// Whether one of these cells stops a ray in a slice of this layer, which holds them and is not free; or whether
  /// there are so many that one may.
  [[nodiscard]] bool any_stops(std::int64_t slice, const LateralCells& cells) const;
  /// Windows that begin with the cells of `place`, those of words, and hold `cells`, of the slices [first, end) of
  /// such a layer: from the first to the last in which one of `cells` stops a ray. None: `last` is less than `first`.
  Slices cut(std::int64_t first, std::int64_t end, const LateralCells& cells, const SlicePlace& place,
             SliceWindows& windows) const;

 private:
  static constexpr std::size_t kAny = 4;  // after four slices, the cells that stop rays in any of them
  static constexpr std::size_t kPlanes = 5;

  // A row of 64 cells begins at every 32nd column, so that any window is cut from one column of rows.
  struct Layer {
    bool is_read = false;
    std::int32_t free = 0;
    std::int32_t first_u = 0;  // cells, those of words
    std::int32_t first_v = 0;
    std::int32_t end_u = 0;
    std::int32_t end_v = 0;
    std::size_t rows = 0;   // of a column, with those that windows of the last stick out by
    std::size_t first = 0;  // of its rows
  };

  [[nodiscard]] const Layer& layer_of(std::int64_t slice) {
    const std::size_t number = number_of(slice);
    if (number >= layers_.size() || !layers_[number].is_read) {
      read(number, slice);
    }
    return layers_[number];
  }
  [[nodiscard]] std::size_t number_of(std::int64_t slice) const {
    const std::int32_t words = (beam_.along(slice) >> 2) - (beam_.first_along >> 2);
    return static_cast<std::size_t>(beam_.axes.up ? words : -words);
  }
  // Rows of a column in a plane.
  template <class Plane>
  [[nodiscard]] const std::uint64_t* rows_of(const Layer& layer, std::int32_t column, Plane plane) const {
    return &rows_[layer.first +
                  (static_cast<std::size_t>(column) * kPlanes + static_cast<std::size_t>(plane)) * layer.rows];
  }
  void read(std::size_t number, std::int64_t slice);
  [[nodiscard]] bool read_rows(const Layer& layer, std::int32_t along);
  [[nodiscard]] std::int32_t free_from(const Layer& layer, std::int32_t along);

  BlockingGrid::Reader reader_;
  InstructionSet set_;
  SliceBeam beam_;
  std::vector<Layer> layers_;
  std::vector<std::uint64_t> rows_;
};

}  // namespace vantage
