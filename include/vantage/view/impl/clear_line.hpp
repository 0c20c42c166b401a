// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::detail {

/// Whether all cells that the line from `from_m` (metres, world) to the centre of `unknown` touches, edges included,
/// are free; `unknown` itself does not count. The audit of a finished run has the same rule.
inline bool is_clear_line(const OccupancyMap& map, const Eigen::Vector3d& from_m, const VoxelIndex& unknown) {
  return VoxelRay(map.frame(), from_m, map.frame().centre_of(unknown)).all_touched([&](const VoxelIndex& cell) {
    return cell == unknown || map.at(cell) == Occupancy::Free;
  });
}

}  // namespace vantage::detail
