// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/ray_caster.hpp>
#include <vantage/raytrace/view_rays.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A cell that a ray passes inside the box of an object.
struct RayCell {
  VoxelIndex cell;                           ///< index of the cell
  Occupancy occupancy = Occupancy::Unknown;  ///< state of the cell
  double probability = 0.5;                  ///< probability of being occupied, `P_o`; 1/2 if unknown
  double entropy = 0.0;                      ///< entropy of that probability, `I_o`, in nats
};

/// The information gain of one ray of a view: a number >= 0. The argument lists the cells that the ray passes inside
/// the object's box, in order, up to and including the first occupied one. Any function can be used; it must be safe
/// to call from several threads. The functions below are from Delmerico, Isler, Sabzevari & Scaramuzza 2018, "A
/// comparison of volumetric information gain metrics for active 3D object reconstruction"; docs/reconstruction.md
/// gives their equations.
using RayGain = std::function<double(std::span<const RayCell>)>;

/// Creates a RayGain for the current state of a map and the box of an object in it.
using RayGainMaker = std::function<RayGain(const OccupancyMap&, const VoxelBox&)>;

/// Occlusion aware gain: the sum of I_v(x) = P_v(x) I_o(x) over the ray. P_v is the probability that all cells before
/// x are free.
[[nodiscard]] RayGain occlusion_aware();
/// Unobserved voxel gain: the sum of I_v over the unknown cells.
[[nodiscard]] RayGain unobserved_voxel();
/// Rear side voxel gain: 1 if the ray hits a surface from behind, that is an occupied cell directly after an unknown
/// one, otherwise 0.
[[nodiscard]] RayGain rear_side_voxel();
/// Rear side entropy gain: I_v of that unknown cell, otherwise 0.
[[nodiscard]] RayGain rear_side_entropy();
/// Proximity count gain: the sum of d_max - d(x) over the unknown cells with d(x) < d_max. d(x) is the distance
/// between the centres of x and of the nearest occupied cell of the box, metres. Throws std::invalid_argument unless
/// `d_max_m` is finite and > 0.
[[nodiscard]] RayGain proximity_count(const OccupancyMap& map, const VoxelBox& object, double d_max_m = 0.3);

/// Returns one of the five gains by name: occlusion-aware, unobserved-voxel, rear-side-voxel, rear-side-entropy or
/// proximity-count. Throws std::invalid_argument, which lists the names, for any other name.
[[nodiscard]] RayGainMaker ray_gain_named(std::string_view name);
/// The names that `ray_gain_named` accepts.
[[nodiscard]] const std::vector<std::string_view>& ray_gain_names();

/// The information gain `G(v)` of a view of an object: a RayGain summed over all rays of the view.
///
/// Outside the box a ray ends at the first cell that is not free, as in RayCaster. Inside the box it passes through
/// unknown cells to the first occupied one. Cells closer than the sensor's minimum range stop rays but are not
/// counted.
class ViewGain {
 public:
  /// Copies the object's cells from `map`, which must be the up-to-date map of `caster`. `caster` and `rays` must
  /// outlive the object. Throws std::invalid_argument if `gain` is empty.
  ViewGain(const OccupancyMap& map, const RayCaster& caster, const ViewRays& rays, const VoxelBox& object,
           RayGain gain);

  /// The gain of a view, computed by `threads` threads. The sum does not depend on their number. Throws
  /// std::invalid_argument if `threads` is 0, as RayCaster::cast, and whatever the gain throws.
  [[nodiscard]] double operator()(const Pose& world_from_sensor, std::size_t threads = 1) const;

 private:
  [[nodiscard]] double of_tile(const Pose& world_from_sensor, const RayTile& tile,
                               std::span<const RayEnd> ends) const;

  const RayCaster* caster_;
  const ViewRays* rays_;
  RayGain gain_;
  VoxelGrid<RayCell> cells_;
};

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/view/impl/information_gain.ipp>
#endif
