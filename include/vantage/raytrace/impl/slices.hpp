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

namespace vantage::detail {

// How rays are cast. Every noun of raytrace/impl/ is named here once.
//
//                  view: a pose and its rays (ViewRays)
//                  group: 4 x 4 tiles; tile: 8 x 8 neighbouring rays, a RayBlock once placed (view_placer)
//                  cone: bounds the directions of a tile or a group
//                    |
//      BoxCulling    |  cones that miss the box of interest          BlockingGrid
//      FreeCone      |  cones without a cell that stops a ray          word: 4 x 4 x 4 cells as 64 bits
//                    v                                                 block: 2 x 2 x 2 words
//     visible_cells: ViewWalk                cast: TileWalk            page: 4 x 4 x 4 blocks
//       group by group                         tile by tile            distance: free words around a word
//       SliceFlood: a beam as a set of cells   class by class                |
//       BeamPassages: what it found             |                            |  Reader: keeps the last page
//       Outlook: what that tells of a tile      |                            v
//                    |                          |                    slices: sheets of cells across the major axis
//                    |                          |                    layer: the four slices of a sheet of words
//                    |                          |                      GridSlices: words for one tile
//                    +----------+---------------+                      ViewSlices: rows of cells for a view
//                               v                                            |
//                           SliceWalk  <--- Stop, SliceWindows --------------+
//                             SliceBeam through free layers
//                             SliceLanes in windows, 64 rays at a time
//                             SliceHits: the rays that these stopped, with their cells, and the doubtful rays
//                             |            |
//                             |            +--- doubtful rays ---> SingleWalk: one ray, exactly
//                             v                                            |
//                          HitSink: TileHits or CellStamps  <--------------+
//
// class    rays with the same major axis, along which they advance fastest, and the same direction on it (SliceAxes);
//          the other two axes are the lateral axes u and v
// slope    lateral cells per cell along the major axis; RayLines holds the slopes and lengths of 64 rays
// beam     a range of slopes that bounds rays of a class, drawn in map/impl/slice_beam.hpp; LateralCells: the
//          rectangle of cells, along both lateral axes, in which its rays may be in some slices
// stop     the next slices in which a cell may stop a ray of a beam
// window   32 x 16 cells of a slice as a bit mask; SlicePlace tells where it lies; patch: a rectangle in it
// passage  the windows of a stop, and the cells in them that are still wanted
// level    resolution of a caster: a cell has an edge of 2^level finest cells

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

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/slices.ipp>
#endif
