// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vantage/planner/assume_free.hpp>

#include <vantage/robot/impl/body_cells.hpp>
#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr double kFurthestClearM = 5.0;

}  // namespace detail

// The body is the ellipsoid inscribed in its box: the corners of the box may contain a wall.
VANTAGE_INLINE void assume_free(OccupancyMap& map, const Platform& platform, const Pose& pose, double clearance_m) {
  detail::require_option(clearance_m >= 0.0 && clearance_m <= detail::kFurthestClearM, "assume_free: clearance_m",
                         clearance_m, "in [0, 5] metres");
  const Box body = platform.body_box(pose);
  const VoxelFrame& frame = map.frame();
  const Eigen::Vector3d half = (0.5 * body.extent()).cwiseMax(1e-9);
  const double cell_m = map.resolution_m() * (1.0 + 1e-9);
  const Eigen::Vector3d clear = Eigen::Vector3d::Constant(std::max(clearance_m, cell_m));
  const Eigen::Vector3d position = pose.translation();
  const Eigen::Vector3d least = body.min.cwiseMin(position - clear);
  const Eigen::Vector3d most = body.max.cwiseMax(position + clear);
  for_each_cell(VoxelBox{frame.cell_of(least), frame.cell_of(most) + VoxelIndex{1, 1, 1}},
                [&](const VoxelIndex& cell) {
                  const Box box = frame.box_of(cell);
                  const Eigen::Vector3d nearest = body.centre().cwiseMax(box.min).cwiseMin(box.max);
                  const bool in_body = (nearest - body.centre()).cwiseQuotient(half).squaredNorm() <= 1.0 + 1e-9;
                  const double distance_m = box.distance_to(position);
                  if (in_body || distance_m <= cell_m || distance_m < clearance_m) {
                    const Eigen::Vector3d within = 0.25 * box.extent();
                    map.assume_free({box.min + within, box.max - within});
                  }
                });
}

VANTAGE_INLINE double start_clearance_m(const OccupancyMap& map, const Platform& platform,
                                        const RangeSensor& sensor) {
  const Eigen::Vector3d half = detail::clear_half_m(platform.body_box(Pose::Identity()), map);
  // Distance at which an opening of half-width side_m fits into a field of view. A field of view of about 0 is that
  // of a planar sensor; nothing lies beside it, so it needs no distance.
  constexpr double kFlatRad = 1e-2;
  const auto fits_at_m = [](double side_m, double angle_rad) {
    return angle_rad > kFlatRad && angle_rad < std::numbers::pi ? side_m / std::tan(0.5 * angle_rad) : 0.0;
  };
  const double side_m = std::max(half.x(), half.y());
  const double blind_m = std::max({fits_at_m(half.z(), sensor.vertical_angle_rad()),
                                   fits_at_m(side_m, sensor.horizontal_angle_rad()), sensor.min_range_m});
  return blind_m > 0.0 ? std::min(std::hypot(blind_m, std::max(side_m, half.z())), detail::kFurthestClearM) : 0.0;
}

// Below the lowest rays, which meet the floor furthest away in the corners of the image of a pinhole, or within the
// minimum range.
VANTAGE_INLINE double start_floor_m(const HeightBand& band, const Platform& platform, const RangeSensor& sensor) {
  const HeightBandOptions& heights = band.options();
  const double above_floor_m = heights.sensor_height_m - heights.min_height_m + heights.step_height_m;
  double unseen_m = std::sqrt(std::max(0.0, sensor.min_range_m * sensor.min_range_m - above_floor_m * above_floor_m));
  for (const std::size_t column : {std::size_t{0}, sensor.width - 1}) {
    const Eigen::Vector3d ray = sensor.direction(column, sensor.height - 1);
    if (ray.y() * sensor.max_range_m <= above_floor_m) {
      throw std::invalid_argument(
          "HeightBandOptions::needs_floor: the lowest rays of the sensor do not reach a floor " +
          std::to_string(above_floor_m) + " m below it, one step below the band");
    }
    unseen_m = std::max(unseen_m, above_floor_m * std::hypot(ray.x(), ray.z()) / ray.y());
  }
  const Eigen::Vector3d half = 0.5 * platform.body_box(Pose::Identity()).extent();
  return std::max(unseen_m, half.head<2>().maxCoeff()) + band.plane().resolution_m();
}

}  // namespace vantage
