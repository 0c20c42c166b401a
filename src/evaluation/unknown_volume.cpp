// SPDX-License-Identifier: MIT
#include "evaluation/unknown_volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage::detail {
namespace {

// Further away a gain says little, and rays take long.
constexpr double kFurthestM = 10.0;
constexpr double kElevationStepRad = 10.0 * std::numbers::pi / 180.0;
constexpr double kColumnRad = 2.0 * std::numbers::pi / UnknownVolume::kColumns;

}  // namespace

UnknownVolume::UnknownVolume(const OccupancyMap& map, const RangeSensor& sensor)
    : map_(map), range_m_(std::min(sensor.max_range_m, kFurthestM)) {
  const VoxelBox space = map.region() ? *map.region() : map.bounds();
  const double height_rad = space.extent().z > 1 ? sensor.vertical_angle_rad() : 0.0;
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(height_rad / kElevationStepRad)));
  const double row_rad = rows > 1 ? height_rad / static_cast<double>(rows) : kElevationStepRad;
  for (std::size_t row = 0; row < rows; ++row) {
    elevations_rad_.push_back((static_cast<double>(row) + 0.5) * row_rad - 0.5 * static_cast<double>(rows) * row_rad);
  }
  beside_ = static_cast<std::size_t>(0.5 * sensor.horizontal_angle_rad() / kColumnRad + 1e-9);
  solid_angle_ = kColumnRad * row_rad;
  for (const double elevation_rad : elevations_rad_) {
    most_ += std::cos(elevation_rad) * solid_angle_ * std::pow(range_m_, 3) / 3.0;
  }
  most_ *= static_cast<double>(std::min(2 * beside_ + 1, kColumns));
}

std::vector<double> UnknownVolume::columns(const Eigen::Vector3d& position, std::uint64_t& operations) const {
  const double step_m = map_.resolution_m();
  const auto steps = static_cast<std::size_t>(std::ceil(range_m_ / step_m - 1e-6));
  std::vector<double> volumes(kColumns, 0.0);
  for (std::size_t column = 0; column < kColumns; ++column) {
    for (const double elevation_rad : elevations_rad_) {
      const Eigen::Vector3d along =
          std::cos(elevation_rad) * direction(column) + std::sin(elevation_rad) * Eigen::Vector3d::UnitZ();
      for (std::size_t step = 0; step < steps; ++step) {
        const double from_m = static_cast<double>(step) * step_m;
        const VoxelIndex cell = map_.frame().cell_of(position + (from_m + 0.5 * step_m) * along);
        const Occupancy state = map_.at(cell);
        ++operations;
        if (state == Occupancy::Occupied || !map_.in_region(cell)) {
          break;
        }
        if (state == Occupancy::Unknown) {
          volumes[column] += std::cos(elevation_rad) * solid_angle_ *
                             (std::pow(std::min(from_m + step_m, range_m_), 3) - std::pow(from_m, 3)) / 3.0;
        }
      }
    }
  }
  return volumes;
}

double UnknownVolume::in_view(const std::vector<double>& columns, std::size_t yaw) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(2 * beside_ + 1, kColumns); ++i) {
    sum += columns[(yaw + kColumns - beside_ + i) % kColumns];
  }
  return sum;
}

Eigen::Vector3d UnknownVolume::direction(std::size_t column) {
  const double yaw_rad = static_cast<double>(column) * kColumnRad;
  return {std::cos(yaw_rad), std::sin(yaw_rad), 0.0};
}

}  // namespace vantage::detail
