// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/vision/line_plot.hpp>
#include <vector>

#include "vision/axis_ticks.hpp"
#include "vision/canvas.hpp"

namespace vantage {
namespace {

using drawing::Align;
using drawing::Canvas;
using drawing::Colour;

constexpr double kPanelWidth = 640.0;
constexpr double kPanelHeight = 460.0;
constexpr double kLeft = 82.0;
constexpr double kRight = 78.0;  // space for the last values of the curves
constexpr double kTop = 88.0;
constexpr double kBottom = 66.0;
constexpr double kText = 10.0;
constexpr double kTextLine = 17.0;
constexpr std::array<Colour, 8> kCurves{{{35, 84, 173},
                                         {214, 90, 29},
                                         {22, 145, 84},
                                         {132, 56, 163},
                                         {190, 150, 20},
                                         {90, 96, 108},
                                         {214, 70, 140},
                                         {40, 170, 190}}};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void extend(double value) {
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  [[nodiscard]] Range or_unit() const {
    if (!(low <= high)) {
      return {0.0, 1.0};
    }
    return high > low ? *this : Range{low, low + 1.0};
  }
};

/// Maps points of a plot to the sheet.
struct Frame {
  cv::Rect2d area;
  Range x;
  Range y;

  [[nodiscard]] cv::Point2d at(double px, double py) const {
    return {area.x + (px - x.low) / (x.high - x.low) * area.width,
            area.y + area.height - (py - y.low) / (y.high - y.low) * area.height};
  }
};

Frame frame_of(const LinePlot& plot, double left) {
  Range x;
  Range y;
  for (const LineSeries& series : plot.series) {
    if (series.x.size() != series.y.size()) {
      throw std::invalid_argument("LineSeries::y of '" + series.name + "' has " + std::to_string(series.y.size()) +
                                  " values, must be " + std::to_string(series.x.size()) + " as x");
    }
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      x.extend(series.x[i]);
      y.extend(series.y[i]);
    }
  }
  x = x.or_unit();
  y = plot.y_range ? Range{plot.y_range->first, plot.y_range->second} : y.or_unit();
  x.low = std::min(x.low, 0.0);
  return {{left + kLeft, kTop, kPanelWidth - kLeft - kRight, kPanelHeight - kTop - kBottom}, x, y};
}

void draw_axes(Canvas& canvas, const LinePlot& plot, const Frame& frame) {
  const double below = frame.area.y + frame.area.height;
  const double right = frame.area.x + frame.area.width;
  const drawing::AxisTicks ys = drawing::axis_ticks(frame.y.low, frame.y.high, 5.0);
  for (const double y : ys.at) {
    const double py = frame.at(0.0, y).y;
    canvas.line({frame.area.x, py}, {right, py}, drawing::kGridLine, 1.0);
    canvas.text({frame.area.x - 10.0, py + 0.5 * kText}, ys.label(y), kText, drawing::kInk, Align::Right);
  }
  const drawing::AxisTicks xs = drawing::axis_ticks(frame.x.low, frame.x.high, 6.0);
  for (const double x : xs.at) {
    const double px = frame.at(x, 0.0).x;
    canvas.line({px, frame.area.y}, {px, below}, drawing::kGridLine, 1.0);
    canvas.line({px, below}, {px, below + 6.0}, drawing::kInk, 1.2);
    canvas.text({px, below + 23.0}, xs.label(x), kText, drawing::kInk, Align::Centre);
  }
  canvas.line({frame.area.x, frame.area.y}, {frame.area.x, below}, drawing::kInk, 1.4);
  canvas.line({frame.area.x, below}, {right, below}, drawing::kInk, 1.4);
  canvas.text({frame.area.x - kLeft + 14.0, 34.0}, plot.title, 13.0, drawing::kInk, Align::Left, true);
  canvas.text({frame.area.x - kLeft + 14.0, 64.0}, plot.y_label, kText + 0.5, drawing::kSoftInk);
  canvas.text({0.5 * (frame.area.x + right), below + 50.0}, plot.x_label, kText + 0.5, drawing::kInk, Align::Centre);
}

// The text at the end of a curve, and its height.
struct EndValue {
  double y;
  std::string text;
  Colour colour;
};

std::optional<EndValue> draw_series(Canvas& canvas, const LinePlot& plot, const Frame& frame, std::size_t index) {
  const LineSeries& series = plot.series[index];
  const Colour colour = kCurves[index % kCurves.size()];
  std::vector<cv::Point2d> run;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) {
      canvas.polyline(run, colour, 2.6);
      run.clear();
      continue;
    }
    run.push_back(frame.at(series.x[i], std::clamp(series.y[i], frame.y.low, frame.y.high)));
    last = i;
  }
  canvas.polyline(run, colour, 2.6);
  if (series.x.size() <= 60) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
        canvas.disc(frame.at(series.x[i], std::clamp(series.y[i], frame.y.low, frame.y.high)), 3.2, colour);
      }
    }
  }
  if (!last) {
    return std::nullopt;
  }
  const cv::Point2d end = frame.at(series.x[*last], std::clamp(series.y[*last], frame.y.low, frame.y.high));
  canvas.disc(end, 5.0, colour);
  return EndValue{end.y, drawing::write_number(series.y[*last], 0.1) + plot.value_unit, colour};
}

// Draws the end values in a column to the right of the plot, as close as possible to the ends of their curves without
// overlaps.
void draw_end_values(Canvas& canvas, const Frame& frame, std::vector<EndValue> values) {
  std::stable_sort(values.begin(), values.end(), [](const EndValue& a, const EndValue& b) { return a.y < b.y; });
  double room_below = frame.area.y + frame.area.height;
  for (auto value = values.rbegin(); value != values.rend(); ++value) {
    value->y = std::min(value->y, room_below);
    room_below = value->y - kTextLine;
  }
  double room_above = frame.area.y;
  for (EndValue& value : values) {
    value.y = std::max(value.y, room_above);
    room_above = value.y + kTextLine;
    canvas.label({frame.area.x + frame.area.width + 12.0, value.y + 0.5 * kText}, value.text, kText, value.colour,
                 Align::Left);
  }
}

void draw_legend(Canvas& canvas, const LinePlot& plot, const Frame& frame) {
  double y = frame.area.y + frame.area.height - 22.0 * static_cast<double>(plot.series.size());
  for (std::size_t i = 0; i < plot.series.size() && plot.series.size() > 1; ++i) {
    const double right = frame.area.x + frame.area.width - 14.0;
    canvas.line({right - 30.0, y}, {right, y}, kCurves[i % kCurves.size()], 2.6);
    canvas.label({right - 38.0, y + 0.5 * kText}, plot.series[i].name, kText, drawing::kInk, Align::Right);
    y += 22.0;
  }
}

}  // namespace

Picture draw_line_plots(std::span<const LinePlot> plots) {
  if (plots.empty()) {
    throw std::invalid_argument("draw_line_plots was given no plot");
  }
  Canvas canvas(kPanelWidth * static_cast<double>(plots.size()), kPanelHeight);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const Frame frame = frame_of(plots[i], kPanelWidth * static_cast<double>(i));
    draw_axes(canvas, plots[i], frame);
    std::vector<EndValue> ends;
    for (std::size_t series = 0; series < plots[i].series.size(); ++series) {
      if (std::optional<EndValue> end = draw_series(canvas, plots[i], frame, series)) {
        ends.push_back(std::move(*end));
      }
    }
    draw_end_values(canvas, frame, std::move(ends));
    draw_legend(canvas, plots[i], frame);
  }
  return canvas.finish();
}

}  // namespace vantage
