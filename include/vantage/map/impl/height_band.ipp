// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vantage/map/height_band.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

// A ray that goes down by 10 degrees passes one more layer within so many columns.
inline constexpr std::int32_t kNearADrop = 6;

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

// The options of the projected map: a copy of those of the map, with a region of one layer.
inline OccupancyMapOptions plane_options(const OccupancyMapOptions& of_map, const HeightBandOptions& options) {
  validate(options);
  OccupancyMapOptions plane = of_map;
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
  if (options.floor != FloorRule::Ignored) {
    const double deepest_m = options.min_height_m - options.step_height_m;
    while (frame.corner_of({0, 0, lowest_floor_}).z() > deepest_m && lowest_floor_ > -kFurthestVoxel) {
      --lowest_floor_;
    }
  }
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
    const bool has_floor = lowest_floor_ < lowest_;
    if (first.z < above_ && first.z + Brick::kSide > lowest_floor_ - (has_floor ? 1 : 0)) {
      // A drop has an effect on columns beside it.
      const std::int32_t around = has_floor && first.z < lowest_ ? Brick::kSide : 0;
      for (std::int32_t y = first.y - around; y <= first.y + around; y += Brick::kSide) {
        for (std::int32_t x = first.x - around; x <= first.x + around; x += Brick::kSide) {
          stale_.emplace(y, x);
        }
      }
    }
  }
  for (const auto& [y, x] : stale_) {
    for_each_cell(VoxelBox{{x, y, layer_}, {x + Brick::kSide, y + Brick::kSide, layer_ + 1}},
                  [&](const VoxelIndex& column) {
                    const Occupancy state = state_of(map, column);
                    if (plane_.at(column) != state) {
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
  return free > 0 && free >= options_.free_share * (above_ - lowest_) ? state_by_floor(map, column)
                                                                      : Occupancy::Unknown;
}

// The state of a column whose cells in the band are free.
VANTAGE_INLINE Occupancy HeightBand::state_by_floor(const OccupancyMap& map, const VoxelIndex& column) const {
  bool all_free = lowest_floor_ < lowest_;
  for (VoxelIndex cell{column.x, column.y, lowest_floor_}; cell.z < lowest_; ++cell.z) {
    const Occupancy state = map.at(cell);
    if (state == Occupancy::Occupied) {
      return Occupancy::Free;
    }
    all_free = all_free && state == Occupancy::Free;
  }
  if (all_free && is_near_a_drop(map, column)) {
    return Occupancy::Occupied;
  }
  return options_.floor != FloorRule::Seen || assumed_.contains(column) ? Occupancy::Free : Occupancy::Unknown;
}

// Rays of a sparse sensor that meet the floor further away pass through the upper part of the cells that hold it.
// Only below a drop do they go further down, there or a little behind the edge.
VANTAGE_INLINE bool HeightBand::is_near_a_drop(const OccupancyMap& map, const VoxelIndex& column) const {
  constexpr std::int32_t kNear = detail::kNearADrop;
  for (std::int32_t y = column.y - kNear; y <= column.y + kNear; ++y) {
    for (std::int32_t x = column.x - kNear; x <= column.x + kNear; ++x) {
      const VoxelIndex below{x, y, lowest_floor_ - 1};
      bool is_drop = map.at(below) != Occupancy::Unknown || !map.in_region(below);
      for (VoxelIndex cell{x, y, lowest_floor_}; is_drop && cell.z < lowest_; ++cell.z) {
        is_drop = map.at(cell) == Occupancy::Free;
      }
      if (is_drop) {
        return true;
      }
    }
  }
  return false;
}

VANTAGE_INLINE void HeightBand::assume_floor(const Box& box) {
  VoxelBox columns = plane_.frame().cells_touched_by(box);
  columns.lo.z = layer_;
  columns.hi.z = layer_ + 1;
  detail::require_option(columns.size() <= OccupancyMap::kMaxBoxCells, "HeightBand::assume_floor: count of columns",
                         columns.size(), "at most OccupancyMap::kMaxBoxCells");
  for_each_cell(columns, [&](const VoxelIndex& column) {
    assumed_.insert(column);
    const VoxelIndex first = Brick::first_cell(Brick::of_cell(column));
    stale_.emplace(first.y, first.x);
  });
}

}  // namespace vantage
