// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/vision/field_picture.hpp>
#include <vector>

#include "vision/axis_ticks.hpp"
#include "vision/map_image.hpp"
#include "vision/map_sheet.hpp"

namespace vantage {
namespace {

using drawing::Canvas;
using drawing::Colour;
using drawing::MapSheet;

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr Colour kFrontier{226, 38, 45};

/// One layer of the field: phi (NaN outside the field) and its rank in [0, 1].
struct Slice {
  VoxelGrid<double> phi;
  std::vector<double> sorted;

  [[nodiscard]] double rank(double value) const {
    if (sorted.size() < 2) {
      return 1.0;
    }
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
    return static_cast<double>(at - sorted.begin()) / static_cast<double>(sorted.size() - 1);
  }
};

Slice slice_of(const FieldContent& content, const VoxelBox& layer) {
  Slice slice{VoxelGrid<double>(layer, kNoValue), {}};
  for (std::size_t i = 0; i < content.cells.size(); ++i) {
    if (layer.contains(content.cells[i])) {
      slice.phi[content.cells[i]] = content.phi[i];
      slice.sorted.push_back(content.phi[i]);
    }
  }
  std::sort(slice.sorted.begin(), slice.sorted.end());
  return slice;
}

void paint(cv::Mat& image, const VoxelBox& layer, const VoxelIndex& cell, Colour colour) {
  image.at<cv::Vec3b>(layer.hi.y - 1 - cell.y, cell.x - layer.lo.x) =
      cv::Vec3b(colour.red, colour.green, colour.blue);
}

cv::Mat image_of(const OccupancyMap& map, const FieldContent& content, const Slice& slice) {
  const VoxelBox& layer = slice.phi.box();
  cv::Mat image(layer.extent().y, layer.extent().x, CV_8UC3);
  for_each_cell(layer, [&](const VoxelIndex& cell) {
    const double phi = slice.phi[cell];
    const Occupancy state = map.at(cell);
    paint(image, layer, cell,
          !std::isnan(phi)               ? drawing::level_colour(slice.rank(phi))
          : state == Occupancy::Occupied ? drawing::kOccupiedSpace
          : state == Occupancy::Free     ? drawing::kFreeSpace
                                         : drawing::kUnknownSpace);
  });
  for (const VoxelIndex& cell : content.frontier) {
    if (layer.contains(cell)) {
      paint(image, layer, cell, kFrontier);
    }
  }
  return image;
}

// The negative gradient at a cell from its neighbours in the layer. Missing neighbours are closed faces.
Eigen::Vector2d downhill(const Slice& slice, const VoxelIndex& cell) {
  const double here = slice.phi[cell];
  const auto phi = [&](std::int32_t dx, std::int32_t dy) {
    const double value = slice.phi.value_or(cell + VoxelIndex{dx, dy, 0}, kNoValue);
    return std::isnan(value) ? here : value;
  };
  return {phi(-1, 0) - phi(1, 0), phi(0, -1) - phi(0, 1)};
}

void draw_arrows(MapSheet& sheet, const Slice& slice, const VoxelFrame& frame) {
  constexpr double kSpacing = 30.0;  // pixels between arrows
  const double cell_pixels = frame.size_m * sheet.pixels_per_metre();
  const auto every = std::max(1, static_cast<std::int32_t>(std::lround(kSpacing / cell_pixels)));
  for_each_cell(slice.phi.box(), [&](const VoxelIndex& cell) {
    const auto phase = [every](std::int32_t i) { return ((i % every) + every) % every; };
    if (phase(cell.x) != every / 2 || phase(cell.y) != every / 2 || std::isnan(slice.phi[cell])) {
      return;
    }
    const Eigen::Vector2d down = downhill(slice, cell);
    const double rank = slice.rank(slice.phi[cell]);
    const Colour colour = rank > 0.55 ? Colour{40, 50, 60} : Colour{214, 222, 232};
    sheet.canvas().arrow(sheet.at(frame.centre_of(cell)), {down.x(), -down.y()}, 19.0, colour, 1.2);
  });
}

void draw_streamline(MapSheet& sheet, const FieldContent& content) {
  std::vector<cv::Point2d> points;
  for (const Eigen::Vector3d& point : content.streamline) {
    points.push_back(sheet.at(point));
  }
  sheet.canvas().polyline(points, drawing::kInk, 6.0);
  sheet.canvas().polyline(points, drawing::kPaper, 3.4);
  if (points.size() > 1) {
    const cv::Point2d goal = points.back();
    sheet.canvas().disc(goal, 7.0, drawing::kInk);
    sheet.canvas().disc(goal, 5.2, drawing::kPaper);
  }
}

void draw_sensor(Canvas& canvas, cv::Point2d at) {
  canvas.disc(at, 9.5, drawing::kInk);
  canvas.disc(at, 7.6, drawing::kPaper);
  canvas.disc(at, 4.4, drawing::kStart);
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value != 0.0 && std::abs(value) < 1e-3 ? "%.0e" : "%.3g", value);
  return text;
}

void draw_legend(MapSheet& sheet, const FieldContent& content, const Slice& slice) {
  const std::string low = slice.sorted.empty() ? "" : short_number(slice.sorted.front());
  const std::string high = slice.sorted.empty() ? "" : short_number(slice.sorted.back());
  sheet.legend_scale(drawing::level_colour, "potential phi (by rank)", low, high);
  sheet.legend([](Canvas& canvas, cv::Point2d at) { draw_sensor(canvas, at); }, "sensor: phi = 1");
  sheet.legend_swatch(kFrontier, "frontier: phi = 0");
  sheet.legend(
      [](Canvas& canvas, cv::Point2d at) {
        canvas.arrow(at, {1.0, 0.0}, 19.0, drawing::kInk, 1.2);
      },
      "downhill");
  if (content.streamline.size() > 1) {
    sheet.legend(
        [](Canvas& canvas, cv::Point2d at) {
          canvas.line(at - cv::Point2d(12.0, 0.0), at + cv::Point2d(12.0, 0.0), drawing::kInk, 6.0);
          canvas.line(at - cv::Point2d(12.0, 0.0), at + cv::Point2d(12.0, 0.0), drawing::kPaper, 3.4);
        },
        "streamline, all heights");
  }
  sheet.legend_swatch(drawing::kOccupiedSpace, "occupied");
  sheet.legend_swatch(drawing::kUnknownSpace, "unknown");
  sheet.legend_swatch(drawing::kFreeSpace, "free, outside the field");
}

}  // namespace

Picture draw_field(const OccupancyMap& map, const FieldContent& content) {
  if (content.cells.size() != content.phi.size()) {
    throw std::invalid_argument("FieldContent::phi has " + std::to_string(content.phi.size()) + " values, must be " +
                                std::to_string(content.cells.size()) + ", one per cell");
  }
  VoxelBox layer = drawing::cells_to_show(map, content.extent);
  const double z_m = content.slice_z_m.value_or(content.sensor_m.z());
  layer.lo.z = map.frame().cell_of({0.0, 0.0, z_m}).z;
  layer.hi.z = layer.lo.z + 1;
  const Slice slice = slice_of(content, layer);
  MapSheet sheet(map.frame().box_of(layer), content.title,
                 "horizontal slice at z = " + drawing::write_number(z_m, 0.01) +
                     " m: downhill leads from the sensor to the frontier");
  sheet.canvas().image(image_of(map, content, slice), sheet.area());
  draw_arrows(sheet, slice, map.frame());
  sheet.draw_axes();
  draw_streamline(sheet, content);
  draw_sensor(sheet.canvas(), sheet.at(content.sensor_m));
  draw_legend(sheet, content, slice);
  return sheet.canvas().finish();
}

}  // namespace vantage
