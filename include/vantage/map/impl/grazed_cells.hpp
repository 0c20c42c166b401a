// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/scan_marks.hpp>
#include <vantage/map/impl/scan_rays.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::detail {

/// Whether a cell is too far from the sensor's cell for being cleared if it is occupied
/// (OccupancyMapOptions::erase_range_m). The sums are of whole numbers, so contraction cannot change them.
inline bool beyond_erase_range(const OccupancyMapOptions& options, const VoxelIndex& sensor, const VoxelIndex& cell) {
  const double x = 1.0 * cell.x - sensor.x;
  const double y = 1.0 * cell.y - sensor.y;
  const double z = 1.0 * cell.z - sensor.z;
  const double most = options.erase_range_m / options.resolution_m;
  return x * x + y * y + z * z > most * most;
}

/// Second step of insertion, after `mark_rays` (see OccupancyMapOptions::keep_grazed_cells): removes the marks of
/// passed rays from surfaces. These are cells occupied in `map` that are beyond the erase range or touch an end cell
/// of a return, and, for each drawn ray, the unbroken run of occupied cells at its end.
/// The last two are both needed: the cells beside an end keep ways in furnished houses short, the runs those of a
/// narrow camera that scans on the move.
void unmark_grazed_cells(const ScanRays& rays, const OccupancyMap& map, RayPolicy policy, ScanMarks& marks);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/grazed_cells.ipp>
#endif
