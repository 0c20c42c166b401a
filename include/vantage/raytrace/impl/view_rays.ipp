// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vantage/map/impl/sensor_frame.hpp>
#include <vantage/raytrace/view_rays.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace detail {

inline constexpr std::size_t kTileSide = 8;               // rays along the side of a tile
inline constexpr std::size_t kGroupSide = 4 * kTileSide;  // rays along the side of a group
static_assert(kGroupSide * kGroupSide == TileHulls::kTiles * RayTile::kRays);

// Column of a place in a tile: the even bits of `place`. The row is `column_of(place >> 1)`, the odd bits.
inline std::size_t column_of(std::size_t place) { return (place & 1U) | (place >> 1U & 2U) | (place >> 2U & 4U); }

inline RayCone cone_around(std::span<const RayTile> tiles) {
  const auto for_each_direction = [&](auto&& visit) {
    for (const RayTile& tile : tiles) {
      for (std::size_t place = 0; place < RayTile::kRays; ++place) {
        visit(tile.direction(place).cast<double>().normalized());
      }
    }
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for_each_direction([&](const Eigen::Vector3d& direction) { sum += direction; });
  // Directions all around have no mean. Their cone then covers all directions, so its axis does not matter.
  constexpr double kLeastMean = 1e-6;
  RayCone cone;
  cone.axis = sum.norm() < kLeastMean ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : Eigen::Vector3d(sum.normalized());
  double least = 1.0;
  for_each_direction([&](const Eigen::Vector3d& direction) { least = std::min(least, cone.axis.dot(direction)); });
  constexpr double kRounding = 1e-7;  // error of directions in single precision
  cone.cos_half_angle = std::max(least - kRounding, -1.0);
  cone.sin_half_angle = std::sqrt(1.0 - cone.cos_half_angle * cone.cos_half_angle);
  return cone;
}

// Corners of the smallest rectangle that contains the directions of a tile, projected onto a plane in front of it.
// nullopt if some ray does not meet such a plane.
inline std::optional<std::array<Eigen::Vector3f, 4>> corners_of(const RayTile& tile, const RayCone& cone) {
  constexpr double kFlattest = 0.1;  // smallest cosine of the angle between a ray and the normal of the plane
  if (cone.cos_half_angle < kFlattest) {
    return std::nullopt;
  }
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  for (std::size_t place = 0; place < RayTile::kRays; ++place) {
    // a direction that an image plane at z = 1 cannot hold
    if (tile.direction(place).cast<double>().normalized().z() < kFlattest) {
      frame = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), cone.axis).toRotationMatrix();
      break;
    }
  }
  Eigen::Array2d least = Eigen::Array2d::Constant(std::numeric_limits<double>::max());
  Eigen::Array2d most = -least;
  for (std::size_t place = 0; place < RayTile::kRays; ++place) {
    const Eigen::Vector3d direction = frame.transpose() * tile.direction(place).cast<double>();
    least = least.min(direction.head<2>().array() / direction.z());
    most = most.max(direction.head<2>().array() / direction.z());
  }
  constexpr double kRounding = 1e-6;  // larger than the rounding of the corners to single precision
  const double slack = kRounding * (1.0 + least.abs().maxCoeff() + most.abs().maxCoeff());
  least -= slack;
  most += slack;
  std::array<Eigen::Vector3f, 4> corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d corner(k % 2 == 0 ? least.x() : most.x(), k < 2 ? least.y() : most.y(), 1.0);
    corners[k] = (frame * corner).cast<float>();
  }
  return corners;
}

}  // namespace detail

VANTAGE_INLINE ViewRays::ViewRays(const RangeSensor& sensor)
    : ViewRays((sensor.validate(), sensor.directions()), sensor.width, sensor.height, sensor.max_range_m,
               sensor.min_range_m) {}

VANTAGE_INLINE ViewRays::ViewRays(const std::vector<Eigen::Vector3f>& directions, std::size_t width,
                                  std::size_t height, double max_range_m, double min_range_m)
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
  for (std::size_t top = 0; top < height; top += detail::kGroupSide) {
    for (std::size_t left = 0; left < width; left += detail::kGroupSide) {
      const std::size_t first = tiles_.size();
      for (std::size_t row = top; row < std::min(top + detail::kGroupSide, height); row += detail::kTileSide) {
        for (std::size_t column = left; column < std::min(left + detail::kGroupSide, width);
             column += detail::kTileSide) {
          add_tile(directions, width, row, column);
        }
      }
      groups_.push_back({detail::cone_around(std::span(tiles_).subspan(first)), first, tiles_.size()});
      add_hulls(groups_.back());
    }
  }
}

// The corners of a tile that has none remain zero. No beam contains them.
VANTAGE_INLINE void ViewRays::add_hulls(const TileGroup& group) {
  TileHulls& hulls = hulls_.emplace_back();
  for (std::size_t i = group.first; i < group.last; ++i) {
    if (const std::optional<std::array<Eigen::Vector3f, 4>> corners = detail::corners_of(tiles_[i], cones_[i])) {
      for (std::size_t k = 0; k < corners->size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          hulls.corners[axis][TileHulls::kTiles * k + i - group.first] =
              (*corners)[k][static_cast<Eigen::Index>(axis)];
        }
      }
    }
  }
}

VANTAGE_INLINE void ViewRays::add_tile(const std::vector<Eigen::Vector3f>& directions, std::size_t width,
                                       std::size_t top, std::size_t left) {
  const std::size_t height = directions.size() / width;
  RayTile& tile = tiles_.emplace_back();
  for (std::size_t place = 0; place < RayTile::kRays; ++place) {
    const std::size_t column = left + detail::column_of(place);
    const std::size_t row = top + detail::column_of(place >> 1U);
    const bool holds = column < width && row < height;
    const std::size_t ray = holds ? row * width + column : top * width + left;
    const Eigen::Vector3f& direction = directions[ray];
    tile.ray[place] = static_cast<std::uint32_t>(ray);
    tile.rays |= std::uint64_t{holds} << place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      tile.directions[axis][place] = direction[static_cast<Eigen::Index>(axis)];
    }
    tile.stretch[place] =
        max_range_m_ / std::sqrt(detail::SensorFrame::squared(direction.x(), direction.y(), direction.z()));
  }
  cones_.push_back(detail::cone_around({&tile, 1}));
}

}  // namespace vantage
