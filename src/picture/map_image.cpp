// SPDX-License-Identifier: MIT
#include "picture/map_image.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "picture/canvas.hpp"

namespace vantage::detail {
namespace {

struct Column {
  std::uint32_t free = 0;
  std::uint32_t occupied = 0;
};

constexpr std::int32_t kMostColumns = 2000;  // maximum number of columns along a side; a picture has fewer pixels

// Median number of occupied cells of a column over open floor: floor and ceiling, which a plan leaves out.
std::uint32_t usual_slabs(const std::vector<Column>& columns) {
  std::vector<std::uint32_t> occupied;
  for (const Column& column : columns) {
    if (column.free > column.occupied) {
      occupied.push_back(column.occupied);
    }
  }
  if (occupied.empty()) {
    return 0;
  }
  const auto middle = occupied.begin() + static_cast<std::ptrdiff_t>(occupied.size() / 2);
  std::nth_element(occupied.begin(), middle, occupied.end());
  return *middle;
}

Colour column_colour(Column column, double height, std::uint32_t slabs) {
  column.occupied -= std::min(column.occupied, slabs);
  height = std::max(1.0, height - slabs);
  const double occupied = column.occupied / height;
  const double free = column.free / height;
  const Colour open = mix(kUnknownSpace, kFreeSpace, free / std::max(1e-9, 1.0 - occupied));
  // A column that is half occupied is still a wall to a viewer, for example below a window or above a door.
  return mix(open, kOccupiedSpace, 1.8 * occupied);
}

}  // namespace

VoxelBox cells_to_show(const OccupancyMap& map) {
  const VoxelBox cells = map.bounds();
  if (cells.empty()) {
    throw std::invalid_argument("a picture of a map needs a known cell");
  }
  return cells;
}

cv::Mat map_from_above(const OccupancyMap& map, const VoxelBox& cells) {
  const VoxelIndex extent = cells.extent();
  const std::int32_t bin = std::max(1, (std::max(extent.x, extent.y) + kMostColumns - 1) / kMostColumns);
  const std::int32_t width = (extent.x + bin - 1) / bin;
  const std::int32_t height = (extent.y + bin - 1) / bin;
  std::vector<Column> columns(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  map.for_each_known([&](const VoxelIndex& cell, Occupancy state) {
    if (!cells.contains(cell)) {
      return;
    }
    const std::int32_t x = (cell.x - cells.lo.x) / bin;
    const std::int32_t y = (cell.y - cells.lo.y) / bin;
    Column& column =
        columns[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    ++(state == Occupancy::Occupied ? column.occupied : column.free);
  });
  const std::uint32_t slabs = extent.z > 1 ? usual_slabs(columns) : 0;
  cv::Mat image(height, width, CV_8UC3);
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) {
      // The last bins may be cut off by the border.
      const double cells_in_bin = static_cast<double>(std::min(bin, extent.x - x * bin)) *
                                  static_cast<double>(std::min(bin, extent.y - y * bin)) * extent.z;
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const Colour colour = column_colour(columns[at], cells_in_bin, slabs);
      image.at<cv::Vec3b>(height - 1 - y, x) = cv::Vec3b(colour.red, colour.green, colour.blue);
    }
  }
  return image;
}

}  // namespace vantage::detail
