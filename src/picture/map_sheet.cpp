// SPDX-License-Identifier: MIT
#include "picture/map_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "picture/axis_ticks.hpp"

namespace vantage::detail {
namespace {

constexpr double kMapSide = 880.0;    // pixels of the longer side of the map
constexpr double kShortSide = 330.0;  // minimum for the shorter side, so that the legend fits
constexpr double kLeft = 72.0;
constexpr double kTop = 84.0;
constexpr double kBottom = 62.0;
constexpr double kLegendGap = 26.0;
constexpr double kLegendWidth = 236.0;
constexpr double kText = 10.0;

double scale_for(const Box& extent) {
  return kMapSide / std::max({extent.max.x() - extent.min.x(), extent.max.y() - extent.min.y(), 1e-6});
}

cv::Rect2d area_for(const Box& extent, double scale) {
  return {kLeft, kTop, std::max(40.0, std::round((extent.max.x() - extent.min.x()) * scale)),
          std::max(40.0, std::round((extent.max.y() - extent.min.y()) * scale))};
}

}  // namespace

MapSheet::MapSheet(const Box& extent, const std::string& title, const std::string& subtitle)
    : extent_(extent),
      pixels_per_metre_(scale_for(extent)),
      area_(area_for(extent, pixels_per_metre_)),
      canvas_(area_.x + std::max(area_.width, kShortSide) + kLegendGap + kLegendWidth,
              area_.y + std::max(area_.height, kShortSide) + kBottom),
      legend_y_(kTop + 8.0) {
  canvas_.text({kLeft, 34.0}, title, 14.0, kInk, Align::Left, true);
  canvas_.text({kLeft, 58.0}, subtitle, kText, kSoftInk);
}

cv::Point2d MapSheet::at(const Eigen::Vector3d& world_m) const {
  return {area_.x + (world_m.x() - extent_.min.x()) * pixels_per_metre_,
          area_.y + area_.height - (world_m.y() - extent_.min.y()) * pixels_per_metre_};
}

void MapSheet::draw_axes() {
  canvas_.frame(area_, kInk, 1.2);
  const double right = area_.x + area_.width;
  const double below = area_.y + area_.height;
  const AxisTicks xs = axis_ticks(extent_.min.x(), extent_.max.x(), std::max(2.0, area_.width / 90.0));
  for (const double x : xs.at) {
    const double px = at({x, 0.0, 0.0}).x;
    canvas_.line({px, below}, {px, below + 6.0}, kInk, 1.2);
    canvas_.text({px, below + 22.0}, xs.label(x), kText, kInk, Align::Centre);
  }
  const AxisTicks ys = axis_ticks(extent_.min.y(), extent_.max.y(), std::max(2.0, area_.height / 90.0));
  for (const double y : ys.at) {
    const double py = at({0.0, y, 0.0}).y;
    canvas_.line({area_.x - 6.0, py}, {area_.x, py}, kInk, 1.2);
    canvas_.text({area_.x - 11.0, py + 0.5 * kText}, ys.label(y), kText, kInk, Align::Right);
  }
  canvas_.text({0.5 * (area_.x + right), below + 46.0}, "x [m]", kText + 1.0, kInk, Align::Centre);
  canvas_.text({12.0, area_.y - 12.0}, "y [m]", kText + 1.0, kInk);
  draw_scale_bar();
}

void MapSheet::draw_scale_bar() {
  const double metres = round_down_to_nice(std::max(0.24 * area_.width, 24.0) / pixels_per_metre_);
  const double length = metres * pixels_per_metre_;
  const cv::Point2d left(area_.x + 20.0, area_.y + area_.height - 20.0);
  const cv::Rect2d plate(left.x - 10.0, left.y - 27.0, length + 20.0, 37.0);
  canvas_.rectangle(plate, kPaper);
  canvas_.frame(plate, kGridLine, 1.0);
  canvas_.rectangle({left.x, left.y - 4.0, 0.5 * length, 6.0}, kInk);
  canvas_.frame({left.x, left.y - 4.0, length, 6.0}, kInk, 1.0);
  canvas_.text({left.x + 0.5 * length, left.y - 10.0}, write_number(metres, metres) + " m", kText, kInk,
               Align::Centre);
}

void MapSheet::legend(const std::function<void(Canvas&, cv::Point2d)>& symbol, const std::string& words) {
  const double left = canvas_.width() - kLegendWidth;
  symbol(canvas_, {left + 13.0, legend_y_});
  canvas_.text({left + 36.0, legend_y_ + 0.5 * kText}, words, kText, kInk);
  legend_y_ += 28.0;
}

void MapSheet::legend_swatch(Colour colour, const std::string& words) {
  legend(
      [colour](Canvas& canvas, cv::Point2d centre) {
        const cv::Rect2d box(centre.x - 12.0, centre.y - 8.0, 24.0, 16.0);
        canvas.rectangle(box, colour);
        canvas.frame(box, kSoftInk, 1.0);
      },
      words);
}

void MapSheet::legend_scale(const std::function<Colour(double)>& colour, const std::string& name,
                            const std::string& low, const std::string& high) {
  const double left = canvas_.width() - kLegendWidth;
  constexpr double kWidth = 200.0;
  canvas_.text({left, legend_y_ + 0.5 * kText}, name, kText, kInk);
  constexpr int kSteps = 100;
  for (int i = 0; i < kSteps; ++i) {
    const double share = (i + 0.5) / kSteps;
    canvas_.rectangle({left + kWidth * i / kSteps, legend_y_ + 16.0, kWidth / kSteps, 14.0}, colour(share));
  }
  canvas_.frame({left, legend_y_ + 16.0, kWidth, 14.0}, kSoftInk, 1.0);
  canvas_.text({left, legend_y_ + 47.0}, low, kText - 1.0, kSoftInk);
  canvas_.text({left + kWidth, legend_y_ + 47.0}, high, kText - 1.0, kSoftInk, Align::Right);
  legend_y_ += 76.0;
}

void draw_start(Canvas& canvas, cv::Point2d at) {
  canvas.disc(at, 12.0, kPaper);
  canvas.disc(at, 10.0, kStart);
  canvas.text({at.x, at.y + 5.0}, "S", 10.0, kPaper, Align::Centre, true);
}

void draw_end(Canvas& canvas, cv::Point2d at) {
  canvas.rectangle({at.x - 11.5, at.y - 11.5, 23.0, 23.0}, kPaper);
  canvas.rectangle({at.x - 9.5, at.y - 9.5, 19.0, 19.0}, kEnd);
  canvas.text({at.x, at.y + 5.0}, "E", 10.0, kPaper, Align::Centre, true);
}

}  // namespace vantage::detail
