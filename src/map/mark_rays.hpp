// SPDX-License-Identifier: MIT
#pragma once

#include <map/scan_marks.hpp>
#include <map/scan_rays.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage {

/// Marks the cells that the rays pass (up to, and without, the cell of their end) and those in which returns lie. Of
/// the rays with a return, only the first into each cell is drawn, to the cell's centre, if the policy says so.
void mark_rays(const ScanRays& rays, const VoxelFrame& frame, RayPolicy policy, ScanMarks& marks);

}  // namespace vantage
