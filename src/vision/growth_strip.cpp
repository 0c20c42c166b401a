// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <vantage/vision/growth_strip.hpp>

#include "vision/canvas.hpp"
#include "vision/map_image.hpp"

namespace vantage {
namespace {

using drawing::Canvas;

constexpr double kWidth = 1280.0;
constexpr double kMargin = 16.0;
constexpr double kGap = 12.0;
constexpr double kTitle = 46.0;
constexpr double kCaption = 34.0;
constexpr double kTallest = 640.0;

void draw_moment(Canvas& canvas, const GrowthMoment& moment, const VoxelBox& cells, const cv::Rect2d& area) {
  canvas.image(drawing::map_from_above(moment.map, cells), area);
  canvas.frame(area, drawing::kSoftInk);
  const Box shown = moment.map.frame().box_of(cells);
  const double scale = area.width / shown.extent().x();
  const auto at = [&](const Eigen::Vector3d& point) {
    return cv::Point2d(area.x + scale * (point.x() - shown.min.x()), area.y + scale * (shown.max.y() - point.y()));
  };
  const std::vector<Eigen::Vector3d>& way = moment.travelled;
  for (const double width : {4.0, 2.0}) {  // light outline first
    for (std::size_t i = 1; i < way.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(way.size());
      canvas.line(at(way[i - 1]), at(way[i]), width > 3.0 ? drawing::kPaper : drawing::journey_colour(share), width);
    }
  }
  if (!way.empty()) {
    canvas.disc(at(way.back()), 5.0, drawing::kPaper);
    canvas.disc(at(way.back()), 3.6, drawing::kEnd);
    canvas.disc(at(way.front()), 5.0, drawing::kPaper);
    canvas.disc(at(way.front()), 3.6, drawing::kStart);
  }
  canvas.text({area.x + 0.5 * area.width, area.y + area.height + 22.0}, moment.caption, 9.5, drawing::kInk,
              drawing::Align::Centre);
}

}  // namespace

Picture draw_growth_strip(std::span<const GrowthMoment> moments, const std::string& title,
                          const std::optional<Box>& extent) {
  if (moments.empty()) {
    throw std::invalid_argument("draw_growth_strip: there is no moment to show");
  }
  const VoxelBox cells = drawing::cells_to_show(moments.back().map, extent);
  const Eigen::Vector3d size = moments.back().map.frame().box_of(cells).extent();
  const double n = static_cast<double>(moments.size());
  double width = (kWidth - 2.0 * kMargin - (n - 1.0) * kGap) / n;
  width = std::min(width, kTallest * size.x() / size.y());
  const double height = width * size.y() / size.x();
  Canvas canvas(2.0 * kMargin + n * width + (n - 1.0) * kGap, kTitle + height + kCaption);
  canvas.text({kMargin, 30.0}, title, 12.0, drawing::kInk, drawing::Align::Left, true);
  double x = kMargin;
  for (const GrowthMoment& moment : moments) {
    draw_moment(canvas, moment, cells, {x, kTitle, width, height});
    x += width + kGap;
  }
  return canvas.finish();
}

}  // namespace vantage
