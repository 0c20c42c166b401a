// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::detail {

/// The box of all known cells. Throws std::invalid_argument if there are none.
[[nodiscard]] VoxelBox cells_to_show(const OccupancyMap& map);

/// The map from above as an RGB image, first row at the largest y. The colour of each column of `cells` mixes free,
/// unknown and occupied by their shares. In very large maps a pixel covers several columns.
[[nodiscard]] cv::Mat map_from_above(const OccupancyMap& map, const VoxelBox& cells);

}  // namespace vantage::detail
