// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vantage/raytrace/view_rays.hpp>

#include "map/option_rule.hpp"

namespace vantage {
namespace {

constexpr std::size_t kSide = 8;

// Column and row in a tile of the place `place`: its even and its odd bits.
std::size_t column_of(std::size_t place) { return (place & 1U) | (place >> 1U & 2U) | (place >> 2U & 4U); }

RayCone cone_around(const RayTile& tile) {
  const auto direction = [&](std::size_t place) {
    return Eigen::Vector3d(tile.directions[3 * place], tile.directions[3 * place + 1], tile.directions[3 * place + 2])
        .normalized();
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t place = 0; place < RayTile::kRays; ++place) {
    sum += direction(place);
  }
  // Directions all around have no mean: their cone is all of space, whatever its axis.
  constexpr double kLeastMean = 1e-6;
  RayCone cone;
  cone.axis = sum.norm() < kLeastMean ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : Eigen::Vector3d(sum.normalized());
  double least = 1.0;
  for (std::size_t place = 0; place < RayTile::kRays; ++place) {
    least = std::min(least, cone.axis.dot(direction(place)));
  }
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
  for (std::size_t top = 0; top < height; top += kSide) {
    for (std::size_t left = 0; left < width; left += kSide) {
      RayTile& tile = tiles_.emplace_back();
      for (std::size_t place = 0; place < RayTile::kRays; ++place) {
        const std::size_t column = left + column_of(place);
        const std::size_t row = top + column_of(place >> 1U);
        const bool holds = column < width && row < height;
        const std::size_t ray = holds ? row * width + column : top * width + left;
        tile.ray[place] = static_cast<std::uint32_t>(ray);
        tile.rays |= std::uint64_t{holds} << place;
        std::copy_n(directions[ray].data(), 3, &tile.directions[3 * place]);
      }
      cones_.push_back(cone_around(tile));
    }
  }
}

}  // namespace vantage
