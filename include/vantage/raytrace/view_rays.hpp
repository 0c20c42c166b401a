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

/// A tile of a view: up to 64 neighbouring rays, a square of 8 x 8 pixels.
struct RayTile {
  static constexpr std::size_t kRays = 64;  ///< maximum number of rays

  /// Directions in the sensor frame: x of all rays, then y, then z. The rays are in Morton order (the bits of column
  /// and row alternate), so neighbours in the image are close in the list. A place without a ray repeats the first
  /// ray.
  std::array<std::array<float, kRays>, 3> directions{};
  std::array<double, kRays> stretch{};     ///< factor that scales each direction to the maximum range, metres
  std::array<std::uint32_t, kRays> ray{};  ///< index of each ray in the image, row by row
  std::uint64_t rays = 0;                  ///< bit mask of the places that hold a ray

  /// Direction of the ray at a place, in the sensor frame.
  [[nodiscard]] Eigen::Vector3f direction(std::size_t place) const {
    return {directions[0][place], directions[1][place], directions[2][place]};
  }
};

/// A cone that contains a set of directions in the sensor frame.
struct RayCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector
  double cos_half_angle = 1.0;                      ///< cosine of the largest angle between the axis and a direction
  double sin_half_angle = 0.0;                      ///< sine of that angle
};

/// A group of neighbouring tiles of a view: a square of up to 4 x 4 tiles.
struct TileGroup {
  RayCone cone;           ///< contains all rays of the group
  std::size_t first = 0;  ///< the tiles are [first, last)
  std::size_t last = 0;   ///< one past the last tile
};

/// The corner directions of the tiles of a group. Every ray of a tile is a linear combination of the four corners of
/// the tile with coefficients >= 0.
struct TileHulls {
  static constexpr std::size_t kTiles = 16;  ///< maximum number of tiles of a group

  /// Directions in the sensor frame: x of all corners, then y, then z. Corner k of tile i of the group is at place 16
  /// k + i. All are zero for a tile that does not exist, or whose rays spread too far to lie in front of one plane.
  std::array<std::array<float, 4 * kTiles>, 3> corners{};
};

/// The rays of a view in the sensor frame: an image of directions with a common maximum range, arranged in tiles and
/// groups for fast tracing (RayCaster, evaluate_view). Create it once per sensor and use it for all poses.
class ViewRays {
 public:
  /// One ray through the centre of every pixel. Throws std::invalid_argument as RangeSensor::validate.
  explicit ViewRays(const RangeSensor& sensor);
  /// `width * height` directions in the sensor frame (any non-zero length), row by row. Tracing is fast only if
  /// neighbours in the image have similar directions. Throws std::invalid_argument if the size is wrong, a direction
  /// is zero or not finite, or unless 0 <= `min_range_m` < `max_range_m` < infinity.
  ViewRays(const std::vector<Eigen::Vector3f>& directions, std::size_t width, std::size_t height, double max_range_m,
           double min_range_m = 0.0);

  /// The number of rays.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Length of a ray, metres.
  [[nodiscard]] double max_range_m() const { return max_range_m_; }
  /// Minimum range, metres: a cell closer than this stops a ray but is not seen.
  [[nodiscard]] double min_range_m() const { return min_range_m_; }
  /// All tiles, ordered by group.
  [[nodiscard]] const std::vector<RayTile>& tiles() const { return tiles_; }
  /// The cone of each tile.
  [[nodiscard]] const std::vector<RayCone>& cones() const { return cones_; }
  /// All groups.
  [[nodiscard]] const std::vector<TileGroup>& groups() const { return groups_; }
  /// The corner directions of each group.
  [[nodiscard]] const std::vector<TileHulls>& hulls() const { return hulls_; }

 private:
  void add_tile(const std::vector<Eigen::Vector3f>& directions, std::size_t width, std::size_t top, std::size_t left);
  void add_hulls(const TileGroup& group);

  std::size_t size_ = 0;
  double max_range_m_ = 0.0;
  double min_range_m_ = 0.0;
  std::vector<RayTile> tiles_;
  std::vector<RayCone> cones_;  // stored apart from the tiles, because more cones than tiles are read
  std::vector<TileGroup> groups_;
  std::vector<TileHulls> hulls_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/view_rays.ipp>
#endif
