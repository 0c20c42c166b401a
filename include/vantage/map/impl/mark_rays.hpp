// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/scan_marks.hpp>
#include <vantage/map/impl/scan_rays.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::detail {

/// First step of insertion: marks the cells that the rays pass, without their end cells, and the end cells of
/// returns. With RayPolicy::EachEndCell, only the first return into each cell is drawn, as a ray to the centre of the
/// cell.
void mark_rays(const ScanRays& rays, const VoxelFrame& frame, RayPolicy policy, ScanMarks& marks);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/map/impl/mark_rays.ipp>
#endif
