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

/// One curve of a LinePlot: points in order, NaN where there is none.
struct LineSeries {
  std::string name = {};       ///< for the legend; a single series needs none
  std::vector<double> x = {};  ///< one per point
  std::vector<double> y = {};  ///< one per point
};

/// Curves over common axes.
struct LinePlot {
  std::string title = {};                                           ///< above the plot
  std::string x_label = {};                                         ///< with its unit
  std::string y_label = {};                                         ///< with its unit
  std::vector<LineSeries> series = {};                              ///< drawn in this order
  std::optional<std::pair<double, double>> y_range = std::nullopt;  ///< none: as the points ask for
  std::string value_unit = {};  ///< follows the last value of a curve, which is written to the right of the plot
};

/// Draws the plots side by side. Throws std::invalid_argument if there is no plot or x and y of a series differ in
/// length.
[[nodiscard]] Picture draw_line_plots(std::span<const LinePlot> plots);

}  // namespace vantage
