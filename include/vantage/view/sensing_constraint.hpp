// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <numbers>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/cell_set.hpp>

namespace VANTAGE_EXPORT vantage {

/// The sensing constraint of Vasquez-Gomez et al. 2013, II-C: takes from the cells that a view sees, from this pose,
/// those that its sensor would not measure. Any function will do. Must be safe to call from several threads.
using SensingConstraint = std::function<void(const Pose&, CellSet&)>;

/// What `measurable` asks of a cell. The field of view is that of the rays.
struct SensingOptions {
  /// The vision angle: how far the line of sight may be from the normal of the surface, radians, in (0, pi / 2].
  double max_incidence_rad = std::numbers::pi / 2;
  /// The depth of view, to the middle of a cell, metres.
  double min_depth_m = 0.0;
  double max_depth_m = std::numeric_limits<double>::infinity();  ///< > min_depth_m

  /// Whether any cell may be refused.
  [[nodiscard]] bool restricts() const {
    return max_incidence_rad < std::numbers::pi / 2 || min_depth_m > 0.0 ||
           max_depth_m < std::numeric_limits<double>::infinity();
  }
};

/// Throws std::invalid_argument naming the option at fault.
void validate(const SensingOptions& options);

/// Outward normal of the surface of what is not known to be free, at a cell of it: from what is not free around it,
/// up to two cells off, to what is. Unit; zero where neither side outweighs the other (a lone cell). Of the sides of
/// a thin sheet it takes none.
[[nodiscard]] Eigen::Vector3f surface_normal(const OccupancyMap& map, const VoxelIndex& cell);

/// The constraint for cells of `object` in the map as it is now: a cell is measured if its middle is within the depth
/// of view and the line of sight is within the vision angle of its normal; where it has no normal, any angle will do.
/// Throws as `validate`.
[[nodiscard]] SensingConstraint measurable(const OccupancyMap& map, const VoxelBox& object,
                                           const SensingOptions& options);

}  // namespace vantage
