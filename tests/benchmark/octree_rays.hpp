// SPDX-License-Identifier: MIT
#pragma once

#include <octomap/octomap.h>

#include <vantage/geometry/box.hpp>
#include <vantage/raytrace/ray_caster.hpp>

namespace vantage {

/// What castRay met, and where: it tells unknown cells from the end of its range only on being asked again.
[[nodiscard]] Occupancy cast_octomap(const octomap::OcTree& tree, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& along, double range_m, octomap::point3d& end);

/// castRay over cells of 2^level finest ones: the inner nodes of an octree, of which OctoMap's own knows nothing.
/// `along` is a unit vector.
[[nodiscard]] RayEnd cast_octomap_at(const octomap::OcTree& tree, int level, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& along, double range_m);

/// Whether a ray of any length meets a box.
[[nodiscard]] bool meets(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& along);

/// What a ray of hierarchical ray tracing ends in that refines inside a box only; frame is that of the cell.
[[nodiscard]] Occupancy counted_inside(const Box& box, const VoxelFrame& frame, const RayEnd& end);

}  // namespace vantage
