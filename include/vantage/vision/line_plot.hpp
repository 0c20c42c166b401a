// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vantage/compiler.hpp>
#include <vantage/vision/picture.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A curve of a LinePlot: a sequence of points. A NaN interrupts the curve.
struct LineSeries {
  std::string name = {};       ///< legend text; not needed for a single curve
  std::vector<double> x = {};  ///< x of each point
  std::vector<double> y = {};  ///< y of each point
};

/// Curves in a common coordinate system.
struct LinePlot {
  std::string title = {};               ///< drawn above the plot
  std::string x_label = {};             ///< label of the x axis, with its unit
  std::string y_label = {};             ///< label of the y axis, with its unit
  std::vector<LineSeries> series = {};  ///< drawn in this order
  /// range of the y axis; nullopt: fitted to the points
  std::optional<std::pair<double, double>> y_range = std::nullopt;
  std::string value_unit = {};  ///< unit after the last value of each curve, which is drawn to the right of the plot
};

/// Draws plots side by side. Throws std::invalid_argument if there is no plot, or if x and y of a series differ in
/// length.
[[nodiscard]] Picture draw_line_plots(std::span<const LinePlot> plots);

}  // namespace vantage
