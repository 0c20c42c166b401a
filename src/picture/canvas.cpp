// SPDX-License-Identifier: MIT
#include "picture/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace vantage::detail {
namespace {

constexpr int kFine = 3;   // supersampling: resolution of the sheet relative to the picture
constexpr int kShift = 4;  // fractional bits of OpenCV's fixed-point coordinates

cv::Scalar scalar(Colour colour) { return {double(colour.red), double(colour.green), double(colour.blue)}; }

cv::Point fixed(cv::Point2d point) {
  const double factor = kFine * (1 << kShift);
  return {static_cast<int>(std::lround(point.x * factor)), static_cast<int>(std::lround(point.y * factor))};
}

int fine(double length) { return std::max(1, static_cast<int>(std::lround(length * kFine))); }

cv::Rect fine_area(const cv::Rect2d& area) {
  const auto at = [](double value) { return static_cast<int>(std::lround(value * kFine)); };
  return {cv::Point(at(area.x), at(area.y)), cv::Point(at(area.x + area.width), at(area.y + area.height))};
}

// Capitals of OpenCV's stroke fonts are 21 units high at scale 1.
double font_scale(double size) { return size * kFine / 21.0; }
int stroke(double size, bool bold) { return fine(size * (bold ? 0.18 : 0.125)); }
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

std::string printable(const std::string& words) {
  std::string ascii;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xC0) {
      continue;  // continuation byte of a UTF-8 character that is already shown as '?'
    }
    ascii += byte < 0x20 || byte >= 0x7F ? '?' : c;
  }
  return ascii;
}

Colour along(std::span<const Colour> stops, double share) {
  const double at = std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return mix(stops[below], stops[below + 1], at - static_cast<double>(below));
}

}  // namespace

Colour mix(Colour a, Colour b, double share_of_b) {
  const double share = std::clamp(share_of_b, 0.0, 1.0);
  const auto channel = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

Colour journey_colour(double share) {
  static constexpr std::array<Colour, 4> kStops{{{35, 84, 173}, {132, 56, 163}, {210, 62, 98}, {240, 140, 32}}};
  return along(kStops, share);
}

Colour level_colour(double share) {
  static constexpr std::array<Colour, 9> kStops{{{68, 1, 84},
                                                 {71, 44, 122},
                                                 {59, 81, 139},
                                                 {44, 113, 142},
                                                 {33, 144, 141},
                                                 {39, 173, 129},
                                                 {92, 200, 99},
                                                 {170, 220, 50},
                                                 {253, 231, 37}}};
  return along(kStops, share);
}

Canvas::Canvas(double width, double height) : sheet_(fine(height), fine(width), CV_8UC3, scalar(kPaper)) {}

double Canvas::width() const { return static_cast<double>(sheet_.cols) / kFine; }
double Canvas::height() const { return static_cast<double>(sheet_.rows) / kFine; }

void Canvas::rectangle(const cv::Rect2d& area, Colour fill) {
  const cv::Rect inside = fine_area(area) & cv::Rect(0, 0, sheet_.cols, sheet_.rows);
  sheet_(inside).setTo(scalar(fill));
}

void Canvas::frame(const cv::Rect2d& area, Colour colour, double thickness) {
  cv::rectangle(sheet_, fine_area(area), scalar(colour), fine(thickness), cv::LINE_8);
}

void Canvas::line(cv::Point2d from, cv::Point2d to, Colour colour, double thickness) {
  cv::line(sheet_, fixed(from), fixed(to), scalar(colour), fine(thickness), cv::LINE_AA, kShift);
}

void Canvas::disc(cv::Point2d centre, double radius, Colour fill) {
  cv::circle(sheet_, fixed(centre), fixed({radius, 0.0}).x, scalar(fill), cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::arrow(cv::Point2d middle, cv::Point2d direction, double length, Colour colour, double thickness) {
  const double norm = std::hypot(direction.x, direction.y);
  if (!(norm > 0.0)) {
    return;
  }
  const cv::Point2d along = direction * (length / norm);
  const cv::Point2d across(-along.y, along.x);
  const cv::Point2d tip = middle + 0.5 * along;
  line(middle - 0.5 * along, tip - 0.25 * along, colour, thickness);
  const std::array<cv::Point, 3> head{fixed(tip), fixed(tip - 0.45 * along + 0.22 * across),
                                      fixed(tip - 0.45 * along - 0.22 * across)};
  cv::fillConvexPoly(sheet_, head, scalar(colour), cv::LINE_AA, kShift);
}

void Canvas::image(const cv::Mat& image, const cv::Rect2d& area) {
  const cv::Rect target = fine_area(area) & cv::Rect(0, 0, sheet_.cols, sheet_.rows);
  const bool shrinks = image.cols > target.width || image.rows > target.height;
  cv::Mat scaled;
  cv::resize(image, scaled, target.size(), 0.0, 0.0, shrinks ? cv::INTER_AREA : cv::INTER_NEAREST);
  scaled.copyTo(sheet_(target));
}

double Canvas::text_width(const std::string& words, double size, bool bold) {
  int baseline = 0;
  const cv::Size extent = cv::getTextSize(printable(words), kFont, font_scale(size), stroke(size, bold), &baseline);
  return static_cast<double>(extent.width) / kFine;
}

void Canvas::text(cv::Point2d at, const std::string& words, double size, Colour colour, Align align, bool bold) {
  const double shift =
      align == Align::Left ? 0.0 : text_width(words, size, bold) * (align == Align::Centre ? 0.5 : 1.0);
  const cv::Point origin(static_cast<int>(std::lround((at.x - shift) * kFine)),
                         static_cast<int>(std::lround(at.y * kFine)));
  cv::putText(sheet_, printable(words), origin, kFont, font_scale(size), scalar(colour), stroke(size, bold),
              cv::LINE_AA);
}

Picture Canvas::finish() const {
  cv::Mat shrunk;
  cv::resize(sheet_, shrunk, {sheet_.cols / kFine, sheet_.rows / kFine}, 0.0, 0.0, cv::INTER_AREA);
  Picture picture{static_cast<std::size_t>(shrunk.cols), static_cast<std::size_t>(shrunk.rows), {}};
  picture.rgb.assign(shrunk.datastart, shrunk.dataend);
  return picture;
}

}  // namespace vantage::detail
