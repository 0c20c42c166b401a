// SPDX-License-Identifier: MIT
#pragma once

#include <octomap/octomap.h>

#include <vantage/geometry/box.hpp>
#include <vantage/raytrace/ray_caster.hpp>

namespace vantage {

/// The result of OctoMap's castRay and its end point. A second query tells unknown cells from the end of the range.
[[nodiscard]] Occupancy cast_octomap(const octomap::OcTree& tree, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& along, double range_m, octomap::point3d& end);

/// A castRay over cells of 2^level finest cells, i.e. inner nodes, which OctoMap's own cannot do. `along` is a unit
/// vector.
[[nodiscard]] RayEnd cast_octomap_at(const octomap::OcTree& tree, int level, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& along, double range_m);

/// Whether a ray of unlimited length intersects a box.
[[nodiscard]] bool meets(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& along);

/// What a ray that was refined only inside `box` counts as, in hierarchical ray tracing; `frame` is that of the end's
/// cell.
[[nodiscard]] Occupancy counted_inside(const Box& box, const VoxelFrame& frame, const RayEnd& end);

}  // namespace vantage
