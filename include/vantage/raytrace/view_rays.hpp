// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Up to 64 neighbouring rays of a view, a square of 8 x 8 of them.
struct RayTile {
  static constexpr std::size_t kRays = 64;  ///< most rays

  /// Directions in the sensor frame: x of all rays, then y, then z. Neighbours are close in the list too (the bits of
  /// column and row alternate). A place without a ray repeats the first.
  std::array<std::array<float, kRays>, 3> directions{};
  std::array<double, kRays> stretch{};     ///< what makes each direction as long as rays reach
  std::array<std::uint32_t, kRays> ray{};  ///< number of each ray in the image, row by row
  std::uint64_t rays = 0;                  ///< a bit for each place that holds a ray

  /// Direction of the ray at a place.
  [[nodiscard]] Eigen::Vector3f direction(std::size_t place) const {
    return {directions[0][place], directions[1][place], directions[2][place]};
  }
};

/// A cone around directions in the sensor frame.
struct RayCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< a unit vector
  double cos_half_angle = 1.0;                      ///< cosine of the angle between it and the directions, at most
  double sin_half_angle = 0.0;                      ///< sine of that angle
};

/// Neighbouring tiles of a view, a square of 4 x 4 of them.
struct TileGroup {
  RayCone cone;           ///< around all of their rays
  std::size_t first = 0;  ///< their numbers: from this one
  std::size_t last = 0;   ///< to the one before this
};

/// Between which directions the rays of the tiles of a group lie: every one of a tile is a sum of its four corners,
/// none of them taken less than zero times.
struct TileHulls {
  static constexpr std::size_t kTiles = 16;  ///< of a group, at most

  /// In the sensor frame: x of all corners, then y, then z. Corner k of tile i of the group is at place 16 k + i; all
  /// are zero of a tile that points all around, or that there is not.
  std::array<std::array<float, 4 * kTiles>, 3> corners{};
};

/// The rays of a view in the sensor frame: an image of directions that all reach equally far, arranged for being
/// traced (RayCaster, evaluate_view). Made once for a sensor and used for every pose of it.
class ViewRays {
 public:
  /// One ray through the centre of every pixel. Throws std::invalid_argument as RangeSensor::validate.
  explicit ViewRays(const RangeSensor& sensor);
  /// `width * height` directions (any non-zero length), row by row. Neighbours in the image should point to nearly
  /// the same place: that is what makes tracing fast. Throws std::invalid_argument naming what is wrong.
  ViewRays(const std::vector<Eigen::Vector3f>& directions, std::size_t width, std::size_t height, double max_range_m,
           double min_range_m = 0.0);

  /// How many rays there are.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// How far a ray reaches, metres.
  [[nodiscard]] double max_range_m() const { return max_range_m_; }
  /// What stops a ray nearer than this is not seen, metres.
  [[nodiscard]] double min_range_m() const { return min_range_m_; }
  /// All rays, in tiles, group by group.
  [[nodiscard]] const std::vector<RayTile>& tiles() const { return tiles_; }
  /// A cone around the rays of each tile.
  [[nodiscard]] const std::vector<RayCone>& cones() const { return cones_; }
  /// All tiles.
  [[nodiscard]] const std::vector<TileGroup>& groups() const { return groups_; }
  /// Around the tiles of each group.
  [[nodiscard]] const std::vector<TileHulls>& hulls() const { return hulls_; }

 private:
  void add_tile(const std::vector<Eigen::Vector3f>& directions, std::size_t width, std::size_t top, std::size_t left);
  void add_hulls(const TileGroup& group);

  std::size_t size_ = 0;
  double max_range_m_ = 0.0;
  double min_range_m_ = 0.0;
  std::vector<RayTile> tiles_;
  std::vector<RayCone> cones_;  // apart: a view looks at more of them than of the tiles
  std::vector<TileGroup> groups_;
  std::vector<TileHulls> hulls_;
};

}  // namespace vantage
