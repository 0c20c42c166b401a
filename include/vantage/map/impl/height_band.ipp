// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vantage/map/height_band.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline void validate(const HeightBandOptions& options) {
  detail::require_option(std::isfinite(options.min_height_m), "HeightBandOptions::min_height_m", options.min_height_m,
                         "finite");
  detail::require_option(std::isfinite(options.max_height_m) && options.max_height_m >= options.min_height_m,
                         "HeightBandOptions::max_height_m", options.max_height_m, ">= min_height_m");
  detail::require_option(std::isfinite(options.sensor_height_m), "HeightBandOptions::sensor_height_m",
                         options.sensor_height_m, "finite");
  detail::require_option(options.free_share > 0.0 && options.free_share <= 1.0, "HeightBandOptions::free_share",
                         options.free_share, "in (0, 1]");
  detail::require_length(options.step_height_m, "HeightBandOptions::step_height_m");
}

// The options of the projected map: a region of one layer, and log-odds by which a cell can be contested.
inline OccupancyMapOptions plane_options(const OccupancyMapOptions& of_map, const HeightBandOptions& options) {
  validate(options);
  OccupancyMapOptions plane{.resolution_m = of_map.resolution_m, .max_bytes = of_map.max_bytes};
  const double size_m = of_map.resolution_m;
  const double layer_m = (std::floor(options.sensor_height_m / size_m) + 0.5) * size_m;
  const double furthest_m = size_m * (kFurthestVoxel - 1);
  Box region =
      of_map.region.value_or(Box{Eigen::Vector3d::Constant(-furthest_m), Eigen::Vector3d::Constant(furthest_m)});
  region.min.z() = layer_m - 0.25 * size_m;
  region.max.z() = layer_m + 0.25 * size_m;
  plane.region = region;
  return plane;
}

}  // namespace detail

VANTAGE_INLINE HeightBand::HeightBand(const OccupancyMapOptions& of_map, const HeightBandOptions& options)
    : options_(options), plane_(detail::plane_options(of_map, options)) {
  const VoxelFrame& frame = plane_.frame();
  Box heights{Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(frame.size_m)};
  heights.min.z() = options.min_height_m;
  heights.max.z() = options.max_height_m;
  const VoxelBox cells = frame.cells_centred_in(heights);
  lowest_ = cells.lo.z;
  above_ = cells.hi.z;
  layer_ = plane_.region()->lo.z;
  lowest_floor_ = lowest_;
  if (options.needs_floor) {
    const double deepest_m = options.min_height_m - options.step_height_m;
    while (frame.corner_of({0, 0, lowest_floor_}).z() > deepest_m && lowest_floor_ > -kFurthestVoxel) {
      --lowest_floor_;
    }
  }
  detail::require_option(!options.needs_floor || lowest_floor_ < lowest_, "HeightBandOptions::step_height_m",
                         options.step_height_m, "such that a cell below the band can hold the floor");
  detail::require_option(lowest_ < above_, "HeightBandOptions::max_height_m", options.max_height_m,
                         "such that the centre of a cell lies between the heights");
  if (of_map.region) {
    const VoxelBox region = frame.cells_centred_in(*of_map.region);
    detail::require_option(lowest_ < region.hi.z, "HeightBandOptions::min_height_m", options.min_height_m,
                           "below the top of the map's region");
    detail::require_option(above_ > region.lo.z, "HeightBandOptions::max_height_m", options.max_height_m,
                           "above the bottom of the map's region");
    detail::require_option(region.lo.z <= layer_ && layer_ < region.hi.z, "HeightBandOptions::sensor_height_m",
                           options.sensor_height_m, "within the map's region");
    if (options.needs_floor && region.lo.z >= lowest_) {
      throw std::invalid_argument(
          "HeightBandOptions::needs_floor: the map's region holds no cell below the band, so no floor is ever seen");
    }
  }
}

VANTAGE_INLINE void HeightBand::follow(const OccupancyMap& map) {
  if (map.resolution_m() != plane_.resolution_m()) {
    throw std::invalid_argument("HeightBand::follow: the cells of the map are of another size");
  }
  if (!map_.is(map)) {
    plane_ = OccupancyMap(plane_.options());
    map_ = KnownMap(map);
    followed_ = 0;
  }
  for (const VoxelIndex& brick : map.changed_since(followed_)) {
    const VoxelIndex first = Brick::first_cell(brick);
    if (first.z < above_ && first.z + Brick::kSide >= lowest_floor_) {
      stale_.emplace(first.y, first.x);
    }
  }
  for (const auto& [y, x] : stale_) {
    for_each_cell(VoxelBox{{x, y, layer_}, {x + Brick::kSide, y + Brick::kSide, layer_ + 1}},
                  [&](const VoxelIndex& column) {
                    const Occupancy state = state_of(map, column);
                    const bool clear = state == Occupancy::Free && has_floor(map, column);
                    if (plane_.at(column) == state && plane_.is_clear(column) == clear) {
                      return;
                    }
                    if (state == Occupancy::Free && !clear) {
                      plane_.set_log_odds(column, -plane_.log_odds_step());  // contested
                    } else {
                      plane_.set(column, state);
                    }
                  });
  }
  stale_.clear();
  if (map.revision() != followed_) {
    plane_.confirm();  // the plane's revision must grow even if nothing in the band has changed
  }
  followed_ = map.revision();
}

VANTAGE_INLINE Occupancy HeightBand::state_of(const OccupancyMap& map, const VoxelIndex& column) const {
  std::int32_t free = 0;
  for (VoxelIndex cell{column.x, column.y, lowest_}; cell.z < above_; ++cell.z) {
    const Occupancy state = map.at(cell);
    if (state == Occupancy::Occupied) {
      return Occupancy::Occupied;
    }
    free += state == Occupancy::Free ? 1 : 0;
  }
  return free > 0 && free >= options_.free_share * (above_ - lowest_) ? Occupancy::Free : Occupancy::Unknown;
}

VANTAGE_INLINE bool HeightBand::has_floor(const OccupancyMap& map, const VoxelIndex& column) const {
  for (VoxelIndex cell{column.x, column.y, lowest_floor_}; cell.z < lowest_; ++cell.z) {
    if (map.at(cell) == Occupancy::Occupied) {
      return true;
    }
  }
  // Rays that meet a floor further away pass through the upper part of the cells that hold it, but not below them.
  const VoxelIndex below{column.x, column.y, lowest_floor_ - 1};
  return !options_.needs_floor || (assumed_.contains(column) && map.at(below) == Occupancy::Unknown);
}

VANTAGE_INLINE void HeightBand::assume_floor(const Eigen::Vector3d& centre_m, double radius_m) {
  detail::require_option(centre_m.allFinite(), "HeightBand::assume_floor: centre_m", centre_m.norm(), "finite");
  detail::require_length(radius_m, "HeightBand::assume_floor: radius_m");
  const VoxelFrame& frame = plane_.frame();
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
  Eigen::Vector3d centre = centre_m;
  centre.z() = frame.centre_of({0, 0, layer_}).z();
  VoxelBox columns{frame.cell_of(centre - reach), frame.cell_of(centre + reach) + VoxelIndex{1, 1, 1}};
  columns.lo.z = layer_;
  columns.hi.z = layer_ + 1;
  detail::require_option(columns.size() <= OccupancyMap::kMaxBoxCells, "HeightBand::assume_floor: count of columns",
                         columns.size(), "at most OccupancyMap::kMaxBoxCells");
  for_each_cell(columns, [&](const VoxelIndex& column) {
    if (frame.box_of(column).distance_to(centre) <= radius_m) {
      assumed_.insert(column);
      const VoxelIndex first = Brick::first_cell(Brick::of_cell(column));
      stale_.emplace(first.y, first.x);
    }
  });
}

}  // namespace vantage
