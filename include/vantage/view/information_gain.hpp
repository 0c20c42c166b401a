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

/// A cell that a ray passes in the box of an object.
struct RayCell {
  VoxelIndex cell;                           ///< which
  Occupancy occupancy = Occupancy::Unknown;  ///< its state
  double probability = 0.5;                  ///< of being occupied, `P_o`; 1/2 where it is unknown
  double entropy = 0.0;                      ///< of that probability, `I_o`, nats
};

/// What one ray of a view may learn: a number >= 0 for the cells that it passes in the box of the object, in order,
/// up to the first occupied one, which is the last. Any function will do; the ones below are Delmerico, Isler,
/// Sabzevari & Scaramuzza 2018, "A comparison of volumetric information gain metrics for active 3D object
/// reconstruction", each by the equation that docs/reconstruction.md writes out. Must be safe to call from several
/// threads.
using RayGain = std::function<double(std::span<const RayCell>)>;

/// Makes a RayGain for a map as it is now and the box of an object in it.
using RayGainMaker = std::function<RayGain(const OccupancyMap&, const VoxelBox&)>;

/// Occlusion aware: the sum of `I_v(x) = P_v(x) I_o(x)`, the entropy of every cell times the likelihood that all
/// before it are free.
[[nodiscard]] RayGain occlusion_aware();
/// Unobserved voxel: the sum of `I_v` over the unknown cells.
[[nodiscard]] RayGain unobserved_voxel();
/// Rear side voxel: 1 if the ray meets a surface from behind, that is an occupied cell right after an unknown one.
[[nodiscard]] RayGain rear_side_voxel();
/// Rear side entropy: `I_v` of that unknown cell.
[[nodiscard]] RayGain rear_side_entropy();
/// Proximity count: the sum of `d_max - d(x)` over the unknown cells that are less than `d_max` from the nearest
/// occupied cell of the box, centre to centre, metres. Throws std::invalid_argument unless `d_max_m` is > 0.
[[nodiscard]] RayGain proximity_count(const OccupancyMap& map, const VoxelBox& object, double d_max_m = 0.3);

/// One of the five by NAME: occlusion-aware, unobserved-voxel, rear-side-voxel, rear-side-entropy, proximity-count.
/// Throws std::invalid_argument listing the names if there is no such gain.
[[nodiscard]] RayGainMaker ray_gain_named(std::string_view name);
/// The names `ray_gain_named` knows.
[[nodiscard]] const std::vector<std::string_view>& ray_gain_names();

/// What views of an object may learn by a RayGain, summed over their rays: `G(v)`, the sum of `I(x)` over all rays of
/// the view and all cells of each.
///
/// Before it reaches the box a ray ends where every other here does, at the first cell that is not free; in the box
/// it goes on through what is unknown to the first occupied cell. Cells nearer than the sensor's minimum range
/// stop rays but are not counted.
class ViewGain {
 public:
  /// For views in the map of `caster`, which must be up to date and outlive it, as must `rays`. Throws
  /// std::invalid_argument unless `gain` can be called.
  ViewGain(const OccupancyMap& map, const RayCaster& caster, const ViewRays& rays, const VoxelBox& object,
           RayGain gain);

  /// `G(v)` of a view, by this many threads, > 0; the same sum for any number of them. Errors as RayCaster::cast, and
  /// whatever the gain throws.
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
