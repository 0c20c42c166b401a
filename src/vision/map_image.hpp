// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::drawing {

/// The cells a picture of `map` shows: those centred in `extent`, or all that are known. Throws std::invalid_argument
/// if there are none.
[[nodiscard]] VoxelBox cells_to_show(const OccupancyMap& map, const std::optional<Box>& extent);

/// The map from above, RGB, the first row at the largest y: each column of `cells` mixes the colours of free, unknown
/// and occupied by their shares. Very large maps get a pixel for several columns.
[[nodiscard]] cv::Mat map_from_above(const OccupancyMap& map, const VoxelBox& cells);

}  // namespace vantage::drawing
