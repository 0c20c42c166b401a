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

/// What a robot that drives must know of the floor under a column of the band.
enum class FloorRule : std::uint8_t {
  Ignored,  ///< nothing: for maps without a floor, such as a floor plan
  NoDrop,   ///< that it is not missing: where every cell down to a step below the band is known free, there is none
  Seen,  ///< that it is there: a cell within a step below the band is occupied, or HeightBand::assume_floor said so
};

/// Which heights of a map count for a robot that drives, and where its plane lies. Cells count whose centres lie
/// between the two heights.
struct HeightBandOptions {
  double min_height_m = 0.1;     ///< lowest z that stands in the robot's way
  double max_height_m = 1.0;     ///< highest z, >= min_height_m
  double sensor_height_m = 0.5;  ///< z of the sensor: its layer of cells is the plane
  /// Share of the cells of a column that must be free before the column is, in (0, 1]. With 1 a camera that sees only
  /// a part of the band from nearby, as most do, is shut in by what it stands beside.
  double free_share = 0.25;
  /// Where a robot may drive. A sensor that looks level does not see the floor beside it: with FloorRule::Seen it
  /// needs HeightBand::assume_floor where it starts.
  FloorRule floor = FloorRule::NoDrop;
  /// The lowest floor, below `min_height_m`, >= 0: cells count whose upper face lies above it. A robot drives down no
  /// deeper step.
  double step_height_m = 0.25;
};

/// A map of one layer of cells: what stands between two heights of another map, projected to the plane of a sensor
/// that does not leave it. Planners explore it like any other map (Shade & Newman 2011 explore in two dimensions, in
/// a single plane of the grid); together with a GroundRobot the harmonic field becomes one of two dimensions.
///
/// A column of the band is occupied if a cell of it is, or if it is a drop (FloorRule::NoDrop); free if at least
/// `free_share` of its cells are free and its floor is as HeightBandOptions::floor asks; else unknown. Its cells lie
/// at the clamping limits, so none is contested: rays at a grazing angle wear a wall away cell by cell, hardly ever a
/// column of it.
///
///     HeightBand band(map.options(), {.min_height_m = 0.1, .max_height_m = 1.2, .sensor_height_m = 0.8});
///     map.insert(scan);
///     band.follow(map);
///     planner->plan(band.plane(), pose);
class HeightBand {
 public:
  /// For maps made with `of_map`; its region, where it has one, bounds the plane. Throws std::invalid_argument naming
  /// the option at fault, if no cell's centre lies in the band, and if the region has none of it or not the sensor.
  HeightBand(const OccupancyMapOptions& of_map, const HeightBandOptions& options);

  /// The options it was made with.
  [[nodiscard]] const HeightBandOptions& options() const { return options_; }
  /// The layer, as followed last.
  [[nodiscard]] const OccupancyMap& plane() const { return plane_; }
  /// Lowest layer of cells that counts, and the one above the highest.
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> layers() const { return {lowest_, above_}; }

  /// Declares that there is a floor where `box` touches a column, as a host may for the place where its robot stands,
  /// from the next `follow` on. What is seen to be a drop remains one.
  void assume_floor(const Box& box);

  /// Brings the plane up to date with `map`; costs what has changed since the last call. Where the map has a new
  /// revision, so has the plane, even if nothing in the band has changed. Another map than the last is projected from
  /// its beginning. Throws std::invalid_argument if its cells are of another size.
  void follow(const OccupancyMap& map);

 private:
  [[nodiscard]] Occupancy state_of(const OccupancyMap& map, const VoxelIndex& column) const;
  [[nodiscard]] Occupancy state_by_floor(const OccupancyMap& map, const VoxelIndex& column) const;

  HeightBandOptions options_;
  std::int32_t lowest_floor_ = 0;  // `lowest_` where the floor does not count
  std::int32_t lowest_ = 0;
  std::int32_t above_ = 0;
  std::int32_t layer_ = 0;
  OccupancyMap plane_;
  KnownMap map_;  // that was followed last
  OccupancyMap::Revision followed_ = 0;
  BrickSet assumed_;                                       // columns of the plane with a floor
  std::set<std::pair<std::int32_t, std::int32_t>> stale_;  // y, x of the columns of bricks to be asked again
};

}  // namespace vantage
