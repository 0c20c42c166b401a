// SPDX-License-Identifier: MIT
#pragma once

#include <map/scan_marks.hpp>
#include <map/scan_rays.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage {

/// Takes back, after `mark_rays`, what rays are marked to have passed of surfaces that the same scan sees
/// (OccupancyMapOptions::keep_grazed_cells): of the cells occupied in `map`, those that touch a cell in which some
/// ray ends, and for each drawn ray the unbroken run that ends with it.
void unmark_grazed_cells(const ScanRays& rays, const OccupancyMap& map, RayPolicy policy, ScanMarks& marks);

}  // namespace vantage
