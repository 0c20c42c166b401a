// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/map/scan.hpp>
#include <vector>

namespace vantage {

/// A ray of a scan: where it ends, in metres, in the world, and in which cell.
struct ScanRay {
  Eigen::Vector3d end;
  VoxelIndex cell;
  bool hits;  ///< whether it ended there by a return; else it only clears
};

/// The usable rays of a scan, all from one origin, and what became of the others.
struct ScanRays {
  Eigen::Vector3d origin;
  std::vector<ScanRay> rays;
  VoxelBox cells;  ///< holds the cells of the origin and of all ends
  ScanReport report;
};

/// The rays to draw, in the order of the scan; with RayPolicy::EachEndCell most returns in the cell of the one before
/// are counted and left out. Throws std::invalid_argument if the pose is not rigid or the range is not positive.
[[nodiscard]] ScanRays rays_of(const Scan& scan, const VoxelFrame& frame, RayPolicy policy);

}  // namespace vantage
