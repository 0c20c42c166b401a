// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/scan_marks.hpp>
#include <vantage/map/impl/scan_rays.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage {

/// Second step of insertion, after `mark_rays` (see OccupancyMapOptions::keep_grazed_cells): removes the marks of
/// passed rays from surfaces that the same scan sees. These are cells occupied in `map` that touch an end cell of a
/// return, and, for each drawn ray, the unbroken run of occupied cells at its end.
void unmark_grazed_cells(const ScanRays& rays, const OccupancyMap& map, RayPolicy policy, ScanMarks& marks);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/grazed_cells.ipp>
#endif
