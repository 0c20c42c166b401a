// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>
#include <vantage/raytrace/impl/slice_walk.hpp>
#include <vector>

namespace vantage {

/// The cells that stop the rays of one class of a view, slice by slice, inside the beam that leads to the box. All
/// tiles of the class cut their windows out of it. A layer (the four slices of a sheet of words) is read when it is
/// first needed.
class ViewSlices {
 public:
  /// The grid must outlive the object.
  ViewSlices(const BlockingGrid& grid, InstructionSet set) : reader_(grid), set_(set) {}

  /// Starts a new beam that reaches up to slice `last`. Returns false if the beam is too wide; the slices must then
  /// not be used.
  bool begin(const SliceBeam& beam, std::int64_t last);

  /// The last slice.
  [[nodiscard]] std::int64_t last() const { return last_; }
  /// The first stop of a beam from this slice on. The beam must be a part of the one of `begin`, or the stop may not
  /// be held.
  [[nodiscard]] Stop next_stop(const SliceBeam& beam, std::int64_t slice);
  /// Cuts the windows of a stop of this beam that is held and small enough (fits_windows). Only the slices from the
  /// first to the last one in which one of the cells of the stop stops a ray are kept.
  void cut(const SliceBeam& beam, const Stop& stop, SliceWindows& windows) const;

 private:
  // Number of layers, from that of this slice on, in which no cell stops a ray.
  [[nodiscard]] std::int32_t free_layers(std::int64_t slice) { return layer_of(slice).free; }
  // Whether the layer of this slice covers all these cells.
  [[nodiscard]] bool hold(std::int64_t slice, const LateralCells& cells) {
    const Layer& layer = layer_of(slice);
    return cells.lo[0] >= layer.first_u && cells.hi[0] < layer.end_u && cells.lo[1] >= layer.first_v &&
           cells.hi[1] < layer.end_v;
  }
  // Whether one of these cells stops a ray in a slice of this layer. Also true if the cells are too many to tell.
  // The layer must cover the cells and must not be free.
  [[nodiscard]] bool any_stops(std::int64_t slice, const LateralCells& cells) const;
  // plane after those of the four slices: the cells that stop rays in any of them
  static constexpr std::size_t kAny = 4;
  static constexpr std::size_t kPlanes = 5;

  // Rows are stored as columns of 64 cells that start every 32 cells. So every window, 32 cells wide, lies inside one
  // column.
  struct Layer {
    bool is_read = false;
    std::int32_t free = 0;
    std::int32_t first_u = 0;  // the covered cells, aligned to words
    std::int32_t first_v = 0;
    std::int32_t end_u = 0;
    std::int32_t end_v = 0;
    std::size_t rows = 0;   // rows per column, with padding so that the last window fits
    std::size_t first = 0;  // index of its first row
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
  // The rows of a column in a plane.
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
  std::int64_t last_ = 0;
  std::vector<Layer> layers_;
  std::vector<std::uint64_t> rows_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/view_slices.ipp>
#endif
