// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/picture/void_picture.hpp>
#include <vector>

#include "picture/map_image.hpp"
#include "picture/map_sheet.hpp"

namespace vantage {
namespace {

using detail::Canvas;
using detail::Colour;
using detail::MapSheet;

constexpr Colour kVoid{148, 74, 196};
constexpr Colour kFrontierCell{226, 38, 45};
constexpr Colour kEllipsoid{72, 20, 110};
constexpr Colour kLow{215, 48, 39};
constexpr Colour kMedium{254, 224, 80};
constexpr Colour kHigh{26, 152, 80};

Colour utility_colour(double share) {
  return share < 0.5 ? detail::mix(kLow, kMedium, 2.0 * share) : detail::mix(kMedium, kHigh, 2.0 * share - 1.0);
}

// An overlay on the map from above, at the resolution of its image.
class Overlay {
 public:
  Overlay(const OccupancyMap& map, const VoxelBox& cells)
      : cells_(cells), image_(detail::map_from_above(map, cells)) {}

  [[nodiscard]] const VoxelBox& cells() const { return cells_; }
  [[nodiscard]] const cv::Mat& image() const { return image_; }
  // Mixes a colour into the pixel of a column.
  void paint(std::int32_t x, std::int32_t y, Colour colour, double share) {
    const VoxelIndex extent = cells_.extent();
    const int column = static_cast<int>(std::int64_t{x - cells_.lo.x} * image_.cols / std::max(1, extent.x));
    const int row =
        image_.rows - 1 - static_cast<int>(std::int64_t{y - cells_.lo.y} * image_.rows / std::max(1, extent.y));
    auto& pixel = image_.at<cv::Vec3b>(row, column);
    const Colour mixed = detail::mix({pixel[0], pixel[1], pixel[2]}, colour, share);
    pixel = cv::Vec3b(mixed.red, mixed.green, mixed.blue);
  }

 private:
  VoxelBox cells_;
  cv::Mat image_;
};

// The number of given cells in every column.
VoxelGrid<std::uint32_t> columns_of(std::span<const VoxelIndex> cells, const VoxelBox& shown) {
  VoxelGrid<std::uint32_t> columns({shown.lo, {shown.hi.x, shown.hi.y, shown.lo.z + 1}}, 0);
  for (const VoxelIndex& cell : cells) {
    if (shown.contains(cell)) {
      ++columns[{cell.x, cell.y, shown.lo.z}];
    }
  }
  return columns;
}

// Draws the outline of an ellipsoid seen from above. It is given by the upper left 2 x 2 block of its shape matrix.
void draw_outline(MapSheet& sheet, const Ellipsoid& ellipsoid) {
  const Eigen::Matrix3d half = ellipsoid.axes * ellipsoid.semi_axes_m.asDiagonal();
  const Eigen::Matrix2d shape = (half * half.transpose()).topLeftCorner<2, 2>();
  // Cholesky factor: shape = f f^T.
  const double f00 = std::sqrt(shape(0, 0));
  const double f10 = shape(1, 0) / f00;
  const double f11 = std::sqrt(std::max(shape(1, 1) - f10 * f10, 0.0));
  constexpr int kCorners = 72;
  std::vector<cv::Point2d> points;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Eigen::Vector3d offset(f00 * std::cos(angle), f10 * std::cos(angle) + f11 * std::sin(angle), 0.0);
    points.push_back(sheet.at(ellipsoid.centre_m + offset));
  }
  const cv::Rect2d& area = sheet.area();
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (area.contains(points[i - 1]) && area.contains(points[i])) {
      sheet.canvas().line(points[i - 1], points[i], kEllipsoid, 2.0);
    }
  }
}

void draw_pose(MapSheet& sheet, const Pose& pose, Colour colour) {
  const cv::Point2d at = sheet.at(pose.translation());
  const Eigen::Vector3d ahead = optical_axis(pose);
  constexpr double kLength = 34.0;
  const cv::Point2d direction(ahead.x(), -ahead.y());
  if (const double level = std::hypot(direction.x, direction.y); level > 0.1) {
    const cv::Point2d middle = at + direction * (0.5 * kLength / level);
    sheet.canvas().arrow(middle, direction, kLength, detail::kPaper, 6.0);
    sheet.canvas().arrow(middle, direction, kLength, colour, 3.0);
  }
  sheet.canvas().disc(at, 8.5, detail::kPaper);
  sheet.canvas().disc(at, 6.5, colour);
}

void legend_pose(MapSheet& sheet, Colour colour, const std::string& words) {
  sheet.legend(
      [colour](Canvas& canvas, cv::Point2d at) {
        canvas.disc(at - cv::Point2d(7.0, 0.0), 5.0, colour);
        canvas.arrow(at + cv::Point2d(3.0, 0.0), {1.0, 0.0}, 18.0, colour, 2.4);
      },
      words);
}

// The common last part of both pictures.
Picture finish(MapSheet& sheet, const VoidContent& content) {
  draw_pose(sheet, content.sensor, detail::kStart);
  legend_pose(sheet, detail::kStart, "sensor");
  if (content.view) {
    draw_pose(sheet, *content.view, detail::kInk);
    legend_pose(sheet, detail::kInk, "next view");
  }
  sheet.legend_swatch(detail::kOccupiedSpace, "occupied");
  sheet.legend_swatch(detail::kUnknownSpace, "unknown");
  sheet.legend_swatch(detail::kFreeSpace, "free");
  return sheet.canvas().finish();
}

}  // namespace

Picture draw_voids(const OccupancyMap& map, const VoidContent& content) {
  Overlay overlay(map, detail::cells_to_show(map));
  const VoxelBox& cells = overlay.cells();
  const VoxelGrid<std::uint32_t> voids = columns_of(content.voids, cells);
  const VoxelGrid<std::uint32_t> frontier = columns_of(content.frontier, cells);
  const double height = std::max(1, cells.extent().z);
  for_each_cell(voids.box(), [&](const VoxelIndex& column) {
    if (voids[column] > 0) {
      overlay.paint(column.x, column.y, kVoid, 0.15 + 0.8 * std::min(1.0, 1.5 * voids[column] / height));
    }
    if (frontier[column] > 0) {
      overlay.paint(column.x, column.y, kFrontierCell, std::min(1.0, 0.4 + 3.0 * frontier[column] / height));
    }
  });
  MapSheet sheet(map.frame().box_of(cells), content.title,
                 "from above, all heights: the deeper the colour, the more cells of the column");
  sheet.canvas().image(overlay.image(), sheet.area());
  for (const Ellipsoid& ellipsoid : content.ellipsoids) {
    draw_outline(sheet, ellipsoid);
  }
  sheet.draw_axes();
  sheet.legend_swatch(kVoid, "void: unknown, in the hull");
  sheet.legend_swatch(kFrontierCell, "frontier");
  sheet.legend(
      [](Canvas& canvas, cv::Point2d at) {
        canvas.line(at - cv::Point2d(12.0, 0.0), at + cv::Point2d(12.0, 0.0), kEllipsoid, 2.0);
      },
      "ellipsoid of a void");
  return finish(sheet, content);
}

Picture draw_void_utility(const OccupancyMap& map, const VoidContent& content) {
  if (content.places.size() != content.utility.size()) {
    throw std::invalid_argument("VoidContent::utility has " + std::to_string(content.utility.size()) +
                                " values, must be " + std::to_string(content.places.size()) + ", one per place");
  }
  Overlay overlay(map, detail::cells_to_show(map));
  const VoxelBox& cells = overlay.cells();
  VoxelGrid<std::uint64_t> best({cells.lo, {cells.hi.x, cells.hi.y, cells.lo.z + 1}}, 0);
  std::uint64_t most = 0;
  for (std::size_t i = 0; i < content.places.size(); ++i) {
    if (cells.contains(content.places[i])) {
      std::uint64_t& here = best[{content.places[i].x, content.places[i].y, cells.lo.z}];
      here = std::max(here, content.utility[i]);
      most = std::max(most, here);
    }
  }
  for_each_cell(best.box(), [&](const VoxelIndex& column) {
    if (best[column] > 0) {
      const double share = static_cast<double>(best[column]) / static_cast<double>(most);
      overlay.paint(column.x, column.y, utility_colour(std::sqrt(share)), 0.9);
    }
  });
  MapSheet sheet(map.frame().box_of(cells), content.title, "from above: the best place of every column");
  sheet.canvas().image(overlay.image(), sheet.area());
  sheet.draw_axes();
  sheet.legend_scale(utility_colour, "utility (square root)", "0", std::to_string(most) + " void cells");
  return finish(sheet, content);
}

}  // namespace vantage
