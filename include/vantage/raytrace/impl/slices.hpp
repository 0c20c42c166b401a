// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/map/impl/slice_beam.hpp>
#include <vantage/raytrace/impl/blocking_grid.hpp>
#include <vantage/raytrace/impl/slice_windows.hpp>

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
//     visible_cells: ViewWalk                cast                      page: 4 x 4 x 4 blocks
//       group by group                         tile by tile            distance: free words around a word
//       SliceFlood: a beam as a set of cells    |                            |
//       BeamPassages: what it found             |                            |  Reader: keeps the last page
//       Outlook: what that tells of a tile      |                            v
//                    |                          |                    Slices: sheets of cells across the major axis
//                    +----------+---------------+                    layer: the four slices of a sheet of words
//                               v                                            |
//                           SliceWalk  <--- Stop, SliceWindows --------------+
//                             class by class
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

/// A stop of a beam: the next slices [slice, next) of one layer in which a cell may stop one of its rays.
struct Stop {
  std::int64_t slice = 0;  ///< there is no stop if this lies behind the last slice
  std::int64_t next = 0;
  LateralCells cells{};  ///< where the rays may be in these slices

  /// Whether windows that start at a word boundary can contain the cells.
  [[nodiscard]] bool fits_windows() const {
    return cells.hi[0] - (cells.lo[0] & ~3) < SliceWindows::kWidth &&
           cells.hi[1] - (cells.lo[1] & ~3) < SliceWindows::kHeight;
  }
};

/// The slices of a grid on the way of a beam. Words are read when they are needed.
class Slices {
 public:
  /// The grid must outlive the object.
  Slices(const BlockingGrid& grid, InstructionSet set) : reader_(grid), set_(set) {}

  /// The first stop of a beam from slice `from` on; it lies behind slice `last` if there is none up to that.
  [[nodiscard]] Stop next_stop(const SliceBeam& beam, std::int64_t from, std::int64_t last);
  /// Cuts the windows of a stop of this beam, which must be small enough (fits_windows). Only the slices from the
  /// first to the last one in which one of the cells of the stop stops a ray are kept.
  void cut(const SliceBeam& beam, const Stop& stop, SliceWindows& windows);

 private:
  [[nodiscard]] std::int32_t free_layers(const SliceAxes& axes, const LateralCells& cells, std::int32_t along);

  BlockingGrid::Reader reader_;
  InstructionSet set_;
};

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/slices.ipp>
#endif
