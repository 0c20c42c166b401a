// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map/sensor_frame.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vantage/raytrace/view_rays.hpp>

#include "map/option_rule.hpp"

namespace vantage {
namespace {

constexpr std::size_t kSide = 8;               // rays of a tile
constexpr std::size_t kGroupSide = 4 * kSide;  // and of a group

// Column and row in a tile of the place `place`: its even and its odd bits.
std::size_t column_of(std::size_t place) { return (place & 1U) | (place >> 1U & 2U) | (place >> 2U & 4U); }

RayCone cone_around(std::span<const RayTile> tiles) {
  const auto for_each_direction = [&](auto&& visit) {
    for (const RayTile& tile : tiles) {
      for (std::size_t place = 0; place < RayTile::kRays; ++place) {
        visit(tile.direction(place).cast<double>().normalized());
      }
    }
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for_each_direction([&](const Eigen::Vector3d& direction) { sum += direction; });
  // Directions all around have no mean: their cone is all of space, whatever its axis.
  constexpr double kLeastMean = 1e-6;
  RayCone cone;
  cone.axis = sum.norm() < kLeastMean ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : Eigen::Vector3d(sum.normalized());
  double least = 1.0;
  for_each_direction([&](const Eigen::Vector3d& direction) { least = std::min(least, cone.axis.dot(direction)); });
  constexpr double kRounding = 1e-7;  // of directions in single precision
  cone.cos_half_angle = std::max(least - kRounding, -1.0);
  cone.sin_half_angle = std::sqrt(1.0 - cone.cos_half_angle * cone.cos_half_angle);
  return cone;
}

}  // namespace

ViewRays::ViewRays(const RangeSensor& sensor)
    : ViewRays((sensor.validate(), sensor.directions()), sensor.width, sensor.height, sensor.max_range_m,
               sensor.min_range_m) {}

ViewRays::ViewRays(const std::vector<Eigen::Vector3f>& directions, std::size_t width, std::size_t height,
                   double max_range_m, double min_range_m)
    : size_(directions.size()), max_range_m_(max_range_m), min_range_m_(min_range_m) {
  detail::require_option(std::isfinite(max_range_m) && max_range_m > 0.0, "ViewRays: max_range_m", max_range_m,
                         "finite and > 0");
  detail::require_option(min_range_m >= 0.0 && min_range_m < max_range_m, "ViewRays: min_range_m", min_range_m,
                         ">= 0 and < max_range_m");
  if (width == 0 || directions.empty() || directions.size() % width != 0 || directions.size() / width != height) {
    throw std::invalid_argument("ViewRays: " + std::to_string(directions.size()) + " directions are no image of " +
                                std::to_string(width) + " x " + std::to_string(height));
  }
  for (const Eigen::Vector3f& direction : directions) {
    if (!direction.allFinite() || direction.isZero(0.0F)) {
      throw std::invalid_argument("ViewRays: every direction must be finite and not zero");
    }
  }
  for (std::size_t top = 0; top < height; top += kGroupSide) {
    for (std::size_t left = 0; left < width; left += kGroupSide) {
      const std::size_t first = tiles_.size();
      for (std::size_t row = top; row < std::min(top + kGroupSide, height); row += kSide) {
        for (std::size_t column = left; column < std::min(left + kGroupSide, width); column += kSide) {
          add_tile(directions, width, row, column);
        }
      }
      groups_.push_back({cone_around(std::span(tiles_).subspan(first)), first, tiles_.size()});
    }
  }
}

void ViewRays::add_tile(const std::vector<Eigen::Vector3f>& directions, std::size_t width, std::size_t top,
                        std::size_t left) {
  const std::size_t height = directions.size() / width;
  RayTile& tile = tiles_.emplace_back();
  for (std::size_t place = 0; place < RayTile::kRays; ++place) {
    const std::size_t column = left + column_of(place);
    const std::size_t row = top + column_of(place >> 1U);
    const bool holds = column < width && row < height;
    const std::size_t ray = holds ? row * width + column : top * width + left;
    const Eigen::Vector3f& direction = directions[ray];
    tile.ray[place] = static_cast<std::uint32_t>(ray);
    tile.rays |= std::uint64_t{holds} << place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      tile.directions[axis][place] = direction[static_cast<Eigen::Index>(axis)];
    }
    tile.stretch[place] = max_range_m_ / std::sqrt(SensorFrame::squared(direction.x(), direction.y(), direction.z()));
  }
  cones_.push_back(cone_around({&tile, 1}));
}

}  // namespace vantage
