// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Directions in the sensor frame, row by row.
struct RayImage {
  std::size_t width = 0;                    ///< columns
  std::size_t height = 0;                   ///< rows
  std::vector<Eigen::Vector3f> directions;  ///< unit vectors
};

/// The rays of a sensor's field of view for cells of `cell_m`, at equal angles arcsin(cell / maximum range) and
/// however many pixels the sensor has (Vasquez-Gomez et al. 2013, eq. 6). Throws std::invalid_argument unless
/// `cell_m` is > 0 and below the maximum range.
[[nodiscard]] RayImage equal_angle_rays(const RangeSensor& sensor, double cell_m);

/// Rays for a series of resolutions, arranged as a tree (Vasquez-Gomez et al. 2013, V-B): every level holds the rays
/// for cells of one size, from coarse to fine, and the parent of a ray is the ray of the level above with which it
/// forms the smallest angle. The root, the sensor's axis, is the parent of all rays of the first level.
class RayTree {
 public:
  /// `levels` levels, the last for cells of `finest_cell_m`, each other for cells twice as large as those of the
  /// next. Throws std::invalid_argument unless `levels` is in [1, 16] and eq. 6 has rays for every level.
  RayTree(const RangeSensor& sensor, double finest_cell_m, int levels);

  /// How many levels there are below the root.
  [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
  /// The rays of a level, 0 the coarsest.
  [[nodiscard]] const RayImage& rays(int level) const { return at(level).image; }
  /// Parent of a ray, as its number in the level above; 0, the root, for those of the first level.
  [[nodiscard]] std::uint32_t parent(int level, std::uint32_t ray) const { return at(level).parents[ray]; }
  /// Children of a ray, as their numbers in the level below; none at the last level, and for a ray that is nobody's
  /// nearest.
  [[nodiscard]] std::span<const std::uint32_t> children(int level, std::uint32_t ray) const {
    const Level& l = at(level);
    return std::span(l.children).subspan(l.first_child[ray], l.first_child[ray + 1] - l.first_child[ray]);
  }
  /// How many rays of the last level descend from a ray; 1 for one of the last level itself.
  [[nodiscard]] std::uint32_t leaves(int level, std::uint32_t ray) const { return at(level).leaves[ray]; }

 private:
  struct Level {
    RayImage image;
    std::vector<std::uint32_t> parents;
    std::vector<std::uint32_t> first_child;  // of every ray in `children`, and the end
    std::vector<std::uint32_t> children;
    std::vector<std::uint32_t> leaves;
  };

  [[nodiscard]] const Level& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  std::vector<Level> levels_;
};

}  // namespace vantage
