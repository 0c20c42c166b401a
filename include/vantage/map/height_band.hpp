// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/map/brick_set.hpp>
#include <vantage/map/known_map.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace VANTAGE_EXPORT vantage {

/// Which heights of a map matter for a ground robot, and at which height the projected plane lies. A cell counts if
/// its centre lies between `min_height_m` and `max_height_m`. All heights are z coordinates in the world frame.
struct HeightBandOptions {
  /// Lower end of the band: the lowest z of an obstacle. It must lie above the floor by more than half a cell and the
  /// noise of the sensor, and by less than `step_height_m`. Otherwise the floor is found in a cell of the band, and
  /// is an obstacle, or it is not found.
  double min_height_m = 0.1;
  double max_height_m = 1.0;     ///< upper end of the band, >= min_height_m
  double sensor_height_m = 0.5;  ///< z of the sensor; the plane is the layer of cells that holds it
  /// Share of the cells of a column that must be free before the column is free, in (0, 1]. A camera that is close to
  /// an obstacle sees only a part of the band. With a share of 1 the columns beside the robot would stay unknown, and
  /// the robot could not leave.
  double free_share = 0.25;
  /// Whether the robot may be only where a floor was seen within one step below the band, or declared
  /// (HeightBand::assume_floor, for the start). False only for maps without a floor: a pit is then not noticed.
  bool needs_floor = true;
  /// The deepest step that the robot can drive down, in [0, 1000]. The floor is searched in the cells below the band
  /// whose upper face lies above `min_height_m - step_height_m`.
  double step_height_m = 0.25;
};

/// A two-dimensional map, one layer of cells, projected from the height band of a three-dimensional map. It serves
/// robots that drive, whose sensor stays at a constant height. Planners explore it like any other map. With a
/// GroundRobot, the harmonic field becomes two-dimensional.
///
/// A column is occupied if one of its cells in the band is occupied, free if at least `free_share` of them are free,
/// and otherwise unknown. Rays at a grazing angle may erase single cells of a wall, but rarely all cells of a column.
/// A free column without a floor (HeightBandOptions::needs_floor) is contested: sight passes it, but no body.
///
///     HeightBand band(map.options(), {.min_height_m = 0.1, .max_height_m = 1.2, .sensor_height_m = 0.8});
///     map.insert(scan);
///     band.follow(map);
///     planner->plan(band.plane(), pose);
///
/// Shade & Newman 2011 also explore in two dimensions, in a single plane of the grid.
class HeightBand {
 public:
  /// Creates the band for maps with the options `of_map`. If `of_map` has a region, it also bounds the plane. Throws
  /// std::invalid_argument, which names the option, if an option is out of range, if no cell centre lies in the band,
  /// or if the region does not overlap the band, does not contain the height of the sensor or, if one is
  /// needed, the floor.
  HeightBand(const OccupancyMapOptions& of_map, const HeightBandOptions& options);

  /// The options that were passed to the constructor.
  [[nodiscard]] const HeightBandOptions& options() const { return options_; }
  /// The projected layer, as of the last `follow`.
  [[nodiscard]] const OccupancyMap& plane() const { return plane_; }
  /// The layers of cells in the band, as a half-open range of z indices [first, second).
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> layers() const { return {lowest_, above_}; }

  /// Declares that a floor exists in every column at most `radius_m` metres from `centre_m` (world frame), for
  /// example where the robot stands: start_floor_m. Takes effect at the next `follow`, but not in a
  /// column in which something is known of the cell below the step. Throws std::invalid_argument unless the centre is
  /// finite and the radius in [0, 1000], and if the disc touches more than OccupancyMap::kMaxBoxCells columns.
  void assume_floor(const Eigen::Vector3d& centre_m, double radius_m);

  /// Updates the plane from `map`. The cost depends on what has changed since the last call. If the revision of `map`
  /// has grown, the revision of the plane grows too, even if nothing in the band has changed. If `map` is not the map
  /// of the last call, the plane is rebuilt from the start. Throws std::invalid_argument if the cell size differs.
  void follow(const OccupancyMap& map);

 private:
  [[nodiscard]] Occupancy state_of(const OccupancyMap& map, const VoxelIndex& column) const;
  [[nodiscard]] bool has_floor(const OccupancyMap& map, const VoxelIndex& column) const;

  HeightBandOptions options_;
  std::int32_t lowest_floor_ = 0;  // equals `lowest_` if no floor is needed
  std::int32_t lowest_ = 0;
  std::int32_t above_ = 0;
  std::int32_t layer_ = 0;
  OccupancyMap plane_;
  KnownMap map_;  // the map of the last `follow`
  OccupancyMap::Revision followed_ = 0;
  BrickSet assumed_;  // columns of the plane with an assumed floor
  // y, x of the first cell of each 8 x 8 group of columns to update
  std::set<std::pair<std::int32_t, std::int32_t>> stale_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/height_band.ipp>
#endif
