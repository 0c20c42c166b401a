// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vantage/picture/floor_plan.hpp>

#include "picture/axis_ticks.hpp"
#include "picture/map_image.hpp"
#include "picture/map_sheet.hpp"

namespace vantage {
namespace {

using detail::Canvas;
using detail::journey_colour;
using detail::MapSheet;
using detail::write_number;

VoxelBox slice_of(VoxelBox cells, const VoxelFrame& frame, double slice_z_m) {
  cells.lo.z = frame.cell_of({0.0, 0.0, slice_z_m}).z;
  cells.hi.z = cells.lo.z + 1;
  return cells;
}

std::string subtitle_of(const OccupancyMap& map, const FloorPlanContent& content, const Box& shown) {
  const std::string cells =
      " in cells of " + write_number(map.resolution_m(), 0.001 * std::ceil(1000.0 * map.resolution_m())) + " m";
  if (content.slice_z_m) {
    return "horizontal slice at z = " + write_number(*content.slice_z_m, 0.01) + " m," + cells;
  }
  return "seen from above, heights z = " + write_number(shown.min.z(), 0.1) + " to " +
         write_number(shown.max.z(), 0.1) + " m," + cells;
}

void draw_path(MapSheet& sheet, const std::vector<Eigen::Vector3d>& travelled) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < travelled.size(); ++i) {
    length_m += (travelled[i] - travelled[i - 1]).norm();
  }
  // A light outline below the whole path keeps crossings readable.
  for (std::size_t i = 1; i < travelled.size(); ++i) {
    sheet.canvas().line(sheet.at(travelled[i - 1]), sheet.at(travelled[i]), detail::kPaper, 4.6);
  }
  double so_far_m = 0.0;
  for (std::size_t i = 1; i < travelled.size(); ++i) {
    const double step_m = (travelled[i] - travelled[i - 1]).norm();
    sheet.canvas().line(sheet.at(travelled[i - 1]), sheet.at(travelled[i]),
                        journey_colour((so_far_m + 0.5 * step_m) / std::max(length_m, 1e-9)), 2.4);
    so_far_m += step_m;
  }
}

void draw_view(Canvas& canvas, cv::Point2d at, cv::Point2d direction, detail::Colour colour) {
  canvas.line(at, at + 17.0 * direction, detail::kPaper, 4.4);
  canvas.disc(at, 5.6, detail::kPaper);
  canvas.line(at, at + 16.0 * direction, colour, 2.4);
  canvas.disc(at, 4.2, colour);
}

void draw_views(MapSheet& sheet, const FloorPlanContent& content) {
  for (std::size_t i = 0; i < content.views.size(); ++i) {
    const Eigen::Vector3d axis = optical_axis(content.views[i]);
    const cv::Point2d direction = content.show_directions ? cv::Point2d(axis.x(), -axis.y()) : cv::Point2d(0.0, 0.0);
    const double share =
        content.views.size() > 1 ? static_cast<double>(i) / static_cast<double>(content.views.size() - 1) : 0.0;
    draw_view(sheet.canvas(), sheet.at(content.views[i].translation()), direction, journey_colour(share));
  }
}

void draw_legend(MapSheet& sheet, const FloorPlanContent& content) {
  sheet.legend_swatch(detail::kFreeSpace, "free");
  sheet.legend_swatch(detail::kOccupiedSpace, "occupied");
  if (!content.slice_z_m) {
    sheet.legend_swatch(detail::kPartlyOccupiedSpace, "free at some heights");
  }
  sheet.legend_swatch(detail::kUnknownSpace, "unknown");
  if (!content.travelled.empty()) {
    sheet.legend([](Canvas& canvas, cv::Point2d at) { draw_start(canvas, at); }, "start");
    sheet.legend([](Canvas& canvas, cv::Point2d at) { draw_end(canvas, at); }, "end");
  }
  if (!content.views.empty()) {
    const cv::Point2d direction = content.show_directions ? cv::Point2d(1.0, 0.0) : cv::Point2d(0.0, 0.0);
    sheet.legend(
        [direction](Canvas& canvas, cv::Point2d at) {
          draw_view(canvas, at - 6.0 * direction, direction, journey_colour(0.3));
        },
        content.show_directions ? "scan, looking that way" : "scan, all around");
  }
  if (content.next) {
    sheet.legend(
        [](Canvas& canvas, cv::Point2d at) {
          draw_view(canvas, at - cv::Point2d(6.0, 0.0), {1.0, 0.0}, detail::kEnd);
        },
        "view chosen next");
  }
  if (content.travelled.size() > 1 || content.views.size() > 1) {
    sheet.legend_scale(journey_colour, "path and scans, in order", "first", "last");
  }
}

}  // namespace

Picture draw_floor_plan(const OccupancyMap& map, const FloorPlanContent& content) {
  VoxelBox cells = detail::cells_to_show(map);
  if (content.slice_z_m) {
    cells = slice_of(cells, map.frame(), *content.slice_z_m);
  }
  const Box shown = map.frame().box_of(cells);
  MapSheet sheet(shown, content.title, subtitle_of(map, content, shown));
  sheet.canvas().image(detail::map_from_above(map, cells), sheet.area());
  sheet.draw_axes();
  draw_path(sheet, content.travelled);
  draw_views(sheet, content);
  if (!content.travelled.empty()) {
    draw_end(sheet.canvas(), sheet.at(content.travelled.back()));
    draw_start(sheet.canvas(), sheet.at(content.travelled.front()));
  }
  if (content.next) {
    const Eigen::Vector3d axis = optical_axis(*content.next);
    draw_view(sheet.canvas(), sheet.at(content.next->translation()), {axis.x(), -axis.y()}, detail::kEnd);
  }
  draw_legend(sheet, content);
  return sheet.canvas().finish();
}

}  // namespace vantage
