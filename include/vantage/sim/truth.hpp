// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/height_band.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/true_cells.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A world as cells of one resolution in one region: what a perfect map of it says.
class Truth {
 public:
  /// Default distance around the region, metres. No preset sensor has a longer range.
  static constexpr double kAroundM = 25.0;

  /// Rasterises the world exactly (separating axes of each triangle and cell; solid pixels and cells if the world
  /// is a plane). `resolution_m` > 0. Surfaces further than `around_m` (in [0, 10000]) from the region are left out:
  /// choose at least the range of a sensor that does not report rays without return. Throws std::invalid_argument for
  /// a resolution that is not positive, an empty region, a region that is not one layer of cells if the world is a
  /// plane, and more than 2^32 cells.
  Truth(const World& world, double resolution_m, const Box& region, double around_m = kAroundM);

  /// The ground truth of the plane of a band of heights (HeightBand): a column is occupied if a cell of the band
  /// is, else grazed if a cell is, else free. `map` tells where a floor is. Throws as HeightBand.
  [[nodiscard]] Truth in_band(const HeightBandOptions& band) const;

  /// True state of a cell.
  [[nodiscard]] CellTruth at(const VoxelIndex& cell) const { return cells_[cell]; }
  /// True states of the region and of the cells around it in which a ray may end.
  [[nodiscard]] const TrueCells& cells() const { return cells_; }
  /// The region as a map in which every cell is known; grazed cells are occupied. A Platform is asked in this map.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }

  /// A random pose in the largest space of admitted cells joined face to face: level, in a random direction,
  /// without roll. None if the platform is admitted nowhere.
  [[nodiscard]] std::optional<Pose> draw_start(const Platform& platform, std::uint64_t seed) const;

  /// The observable cells: cells of the region, free or not, that the sensor sees from at least one pose. Poses
  /// are taken in the space reachable from `start`, on a lattice of 0.4 m (rounded to whole cells, at least one)
  /// and in the cell of `start`. A pose sees a cell if
  /// - the straight line between the two centres passes free cells only,
  /// - the distance is within the sensor's range (the minimum range counts for surfaces only), and
  /// - for a free cell and a sensor that does not report rays without return, the line goes on to a surface within
  ///   range.
  ///
  /// The orientation is free; if the platform cannot tilt, the level sensor turned towards the cell must have it
  /// in its field of view. With `within`, only cells that touch that box. In raster order; the same for any number
  /// of threads. `on_share` is called now and then with the share of cells done, from one thread at a time. Throws
  /// std::invalid_argument if the sensor is invalid, or if it does not report rays without return and some may end on
  /// a surface further than `around_m` from the region.
  [[nodiscard]] std::vector<VoxelIndex> observable(const Platform& platform, const RangeSensor& sensor,
                                                   const Pose& start, int threads = 1,
                                                   const std::function<void(double share)>& on_share = {},
                                                   const std::optional<Box>& within = std::nullopt) const;

  /// Writes the cells of the region that do not touch the box `unknown` to a map of the same cells.
  void tell_around(const Box& unknown, OccupancyMap& map) const;

  /// Share of `cells` that the map knows with the right state, in [0, 1]; 1 if there are none.
  [[nodiscard]] double coverage(const OccupancyMap& map, const std::vector<VoxelIndex>& cells) const;

  /// The cells that `observable` looks from.
  [[nodiscard]] std::vector<VoxelIndex> lattice(const Platform& platform, const Pose& start) const;

 private:
  Truth(const OccupancyMap& map, TrueCells cells, double longest_range_m)
      : map_(map), region_(*map.region()), cells_(std::move(cells)), longest_range_m_(longest_range_m) {}

  OccupancyMap map_;
  VoxelBox region_;
  TrueCells cells_;  // the region and, around it, what a ray may end on
  // A ray of at most this length from the region can only end on surfaces in `cells_`.
  double longest_range_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace vantage
