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

/// An image of ray directions in the sensor frame, row by row.
struct RayImage {
  std::size_t width = 0;                    ///< columns
  std::size_t height = 0;                   ///< rows
  std::vector<Eigen::Vector3f> directions;  ///< unit vectors
};

/// The rays of the field of view of a sensor, at equal angles arcsin(cell_m / maximum range). The number of pixels of
/// the sensor does not matter. Throws std::invalid_argument if the sensor is invalid, or unless `cell_m` is > 0 and
/// below the maximum range. (Vasquez-Gomez et al. 2013, eq. 6.)
[[nodiscard]] RayImage equal_angle_rays(const RangeSensor& sensor, double cell_m);

/// A tree of rays for a series of resolutions. Each level holds the rays for one cell size, from coarse to fine. The
/// parent of a ray is the ray of the next coarser level with the smallest angle to it. The root is the sensor axis;
/// it is the parent of all rays of the first level. (Vasquez-Gomez et al. 2013, V-B.)
class RayTree {
 public:
  /// Builds `levels` levels. The last level is for cells of `finest_cell_m`; the cell size doubles from each level to
  /// the next coarser one. Throws std::invalid_argument if the sensor is invalid, or unless `levels` is in [1, 16]
  /// and all cell sizes are > 0 and below the maximum range.
  RayTree(const RangeSensor& sensor, double finest_cell_m, int levels);

  /// Number of levels, without the root.
  [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
  /// The rays of a level; level 0 is the coarsest.
  [[nodiscard]] const RayImage& rays(int level) const { return at(level).image; }
  /// The parent of a ray, as an index into the next coarser level; 0, the root, for the rays of level 0.
  [[nodiscard]] std::uint32_t parent(int level, std::uint32_t ray) const { return at(level).parents[ray]; }
  /// The children of a ray, as indices into the next finer level. Empty at the last level, and for a ray that is not
  /// the nearest ray of any finer ray.
  [[nodiscard]] std::span<const std::uint32_t> children(int level, std::uint32_t ray) const {
    const Level& l = at(level);
    return std::span(l.children).subspan(l.first_child[ray], l.first_child[ray + 1] - l.first_child[ray]);
  }
  /// The number of rays of the last level that descend from a ray; 1 for a ray of the last level.
  [[nodiscard]] std::uint32_t leaves(int level, std::uint32_t ray) const { return at(level).leaves[ray]; }

 private:
  struct Level {
    RayImage image;
    std::vector<std::uint32_t> parents;
    std::vector<std::uint32_t> first_child;  // start of each ray's range in `children`, and the end of the last range
    std::vector<std::uint32_t> children;
    std::vector<std::uint32_t> leaves;
  };

  [[nodiscard]] const Level& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  std::vector<Level> levels_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/ray_tree.ipp>
#endif
