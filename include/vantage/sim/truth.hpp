// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What a cell of the true world holds.
enum class CellTruth : std::uint8_t {
  Free,    ///< no surface
  Grazed,  ///< surfaces only within 2 % of the cell's edge from its faces: rounding and a few rays decide what a map
           ///< makes of it, so either state is right; to a body and to sight it is occupied
  Occupied,  ///< a surface passes
};

/// A world as cells, at one resolution and in one region: what a map of it ought to say.
class Truth {
 public:
  /// Rasterises the world exactly (separating axes of each triangle and cell; of each solid pixel and cell where the
  /// world is a plane). Throws std::invalid_argument for a resolution that is not positive or a region that is empty,
  /// and if the world is a plane and the region not one layer of cells.
  Truth(const World& world, double resolution_m, const Box& region);

  /// The same for a robot that explores the plane of a band of heights (HeightBand): a column is occupied if a cell
  /// of the band is, else grazed if one is, else free. Throws as HeightBand.
  [[nodiscard]] Truth in_band(const HeightBandOptions& band) const;

  /// True state of a cell.
  [[nodiscard]] CellTruth at(const VoxelIndex& cell) const { return cells_.value_or(cell, CellTruth::Free); }
  /// True states of the region and, around it, of what a ray may end on.
  [[nodiscard]] const VoxelGrid<CellTruth>& cells() const { return cells_; }
  /// Every cell of the region as known: free ones free, grazed and occupied ones occupied. What Platform asks about.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }

  /// A pose drawn from the seed in the largest space of admitted cells joined face to face, looking along a drawn
  /// direction, level. None if the platform is admitted nowhere.
  [[nodiscard]] std::optional<Pose> draw_start(const Platform& platform, std::uint64_t seed) const;

  /// The observable cells: cells of the region, free or not, that the sensor sees from at least one of the poses that
  /// the platform admits, taken on a lattice of 0.4 m (the nearest whole number of cells, at least one) in the space
  /// reachable from `start`, `start`'s own cell included. A pose sees a cell when the straight line between their
  /// centres passes free cells only, the distance is within the sensor's range (its lower end for surfaces only),
  /// and, for a free cell and a sensor that does not report rays without a return, the line goes on to a surface
  /// within range: nothing else would clear the cell. Orientation is free, but for a platform that cannot tilt the
  /// cell must be in view of the level sensor turned towards it. Only cells that touch `within`, if given. In raster
  /// order; the same for any number of threads. `on_share` is told which share of the cells has been asked, now and
  /// then, from one thread at a time.
  [[nodiscard]] std::vector<VoxelIndex> observable(const Platform& platform, const RangeSensor& sensor,
                                                   const Pose& start, int threads = 1,
                                                   const std::function<void(double share)>& on_share = {},
                                                   const std::optional<Box>& within = std::nullopt) const;

  /// Share of `cells` that the map knows with the right state; 1 if there are none.
  [[nodiscard]] double coverage(const OccupancyMap& map, const std::vector<VoxelIndex>& cells) const;

  /// The lattice that `observable` looks from.
  [[nodiscard]] std::vector<VoxelIndex> lattice(const Platform& platform, const Pose& start) const;

 private:
  Truth(const OccupancyMap& map, VoxelGrid<CellTruth> cells)
      : map_(map), region_(*map.region()), cells_(std::move(cells)) {}

  OccupancyMap map_;
  VoxelBox region_;
  VoxelGrid<CellTruth> cells_;  // the region and, around it, what a ray may end on
};

}  // namespace vantage
