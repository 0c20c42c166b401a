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

/// A sensing constraint: given a pose (world_from_sensor) and the cells that are visible from it, removes the cells
/// that the sensor would not measure. Any function can be used; it must be safe to call from several threads.
/// (Vasquez-Gomez et al. 2013, II-C.)
using SensingConstraint = std::function<void(const Pose&, CellSet&)>;

/// Conditions of `measurable`. The field of view is already that of the rays.
struct SensingOptions {
  /// Vision angle: largest angle between the line of sight and the surface normal, radians, in (0, pi / 2].
  double max_incidence_rad = std::numbers::pi / 2;
  /// Depth of view, lower end: distance to the centre of a cell, metres, >= 0.
  double min_depth_m = 0.0;
  double max_depth_m = std::numeric_limits<double>::infinity();  ///< depth of view, upper end, metres, > min_depth_m

  /// Whether the options can exclude any cell.
  [[nodiscard]] bool restricts() const {
    return max_incidence_rad < std::numbers::pi / 2 || min_depth_m > 0.0 ||
           max_depth_m < std::numeric_limits<double>::infinity();
  }
};

/// Throws std::invalid_argument, which names the invalid option.
void validate(const SensingOptions& options);

/// Estimates the outward normal of the surface between free and other space at a cell, from the free cells in the 5 x
/// 5 x 5 neighbourhood. Unit length. Zero if no side dominates, as for a lone cell or for a thin sheet with free
/// space on both sides.
[[nodiscard]] Eigen::Vector3f surface_normal(const OccupancyMap& map, const VoxelIndex& cell);

/// Creates the constraint for cells of `object` in the current state of the map. A cell is measurable if its centre
/// is within the depth of view, and if the line of sight is within the vision angle of its normal. A cell without a
/// normal has no angle limit. Throws as `validate`.
[[nodiscard]] SensingConstraint measurable(const OccupancyMap& map, const VoxelBox& object,
                                           const SensingOptions& options);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/sensing_constraint.ipp>
#endif
