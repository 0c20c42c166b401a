// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vantage/geometry/box.hpp>

#include "vision/canvas.hpp"

namespace vantage::drawing {

/// A page with a map of the world's x-y plane on it, a title above, axes in metres, and a legend to the right.
class MapSheet {
 public:
  /// `extent` must not be empty in x and y.
  MapSheet(const Box& extent, const std::string& title, const std::string& subtitle);

  [[nodiscard]] Canvas& canvas() { return canvas_; }
  /// The part of the page that the map covers.
  [[nodiscard]] const cv::Rect2d& area() const { return area_; }
  [[nodiscard]] double pixels_per_metre() const { return pixels_per_metre_; }
  /// Where a point of the world is on the page; its height does not matter.
  [[nodiscard]] cv::Point2d at(const Eigen::Vector3d& world_m) const;

  /// Frame, ticks, axis names, scale bar: after the map, before what lies over it.
  void draw_axes();
  /// Adds a line to the legend: `symbol` draws around a point about 26 x 16 pixels.
  void legend(const std::function<void(Canvas&, cv::Point2d)>& symbol, const std::string& words);
  void legend_swatch(Colour colour, const std::string& words);
  /// A colour bar from `low` (left) to `high`, with a name above and words at its ends.
  void legend_scale(const std::function<Colour(double)>& colour, const std::string& name, const std::string& low,
                    const std::string& high);

 private:
  void draw_scale_bar();

  Box extent_;
  double pixels_per_metre_;
  cv::Rect2d area_;
  Canvas canvas_;
  double legend_y_;
};

/// Marks with a letter: where a journey starts and ends.
void draw_start(Canvas& canvas, cv::Point2d at);
void draw_end(Canvas& canvas, cv::Point2d at);

}  // namespace vantage::drawing
