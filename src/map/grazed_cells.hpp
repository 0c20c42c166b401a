// SPDX-License-Identifier: MIT
#pragma once

#include <map/scan_marks.hpp>
#include <map/scan_rays.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage {

/// Takes back, after `mark_rays`, what rays are marked to have passed of surfaces that the same scan sees: cells occupied
/// in `map` that touch a cell in which a ray ends (OccupancyMapOptions::keep_grazed_cells).
void unmark_grazed_cells(const ScanRays& rays, const OccupancyMap& map, RayPolicy policy, ScanMarks& marks);

}  // namespace vantage
