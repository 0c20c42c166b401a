// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vantage/map/occupancy_map.hpp>
#include <vector>

namespace vantage::detail {

/// By place: the share of all unknown cells that are further than `seen_m`, metres, from every place, and nearest to
/// this one, in a straight line. Whole bricks are assigned, by their centres. All 0 if nothing is unknown.
///
/// The unknown cells of the region count, up to `beyond_m`, metres, around the box of the known cells. If that box is
/// large, only one around the places counts, and of a very large one bricks at regular distances. So the cost is
/// bounded however much is known: what lies further away is about as far from one place as from the next.
[[nodiscard]] std::vector<double> unknown_shares(const OccupancyMap& map, double beyond_m, double seen_m,
                                                 std::span<const VoxelIndex> places);

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/unknown_shares.ipp>
#endif
