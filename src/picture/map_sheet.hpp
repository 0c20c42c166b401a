// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vantage/geometry/box.hpp>

#include "picture/canvas.hpp"

namespace vantage::detail {

/// A page with a map of the world's x-y plane, a title above, axes in metres, and a legend on the right.
class MapSheet {
 public:
  /// `extent` must not be empty along x and y.
  MapSheet(const Box& extent, const std::string& title, const std::string& subtitle);

  [[nodiscard]] Canvas& canvas() { return canvas_; }
  /// The part of the page that the map covers.
  [[nodiscard]] const cv::Rect2d& area() const { return area_; }
  [[nodiscard]] double pixels_per_metre() const { return pixels_per_metre_; }
  /// Position of a world point on the page; its height is ignored.
  [[nodiscard]] cv::Point2d at(const Eigen::Vector3d& world_m) const;

  /// Draws frame, ticks, axis names and scale bar. Call it after the map image and before overlays.
  void draw_axes();
  /// Adds a legend entry. `symbol` draws within about 26 x 16 pixels around the given point.
  void legend(const std::function<void(Canvas&, cv::Point2d)>& symbol, const std::string& words);
  void legend_swatch(Colour colour, const std::string& words);
  /// Adds a colour bar from `low` (left) to `high` (right) with a title above.
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

/// Markers with a letter for the start and the end of a path.
void draw_start(Canvas& canvas, cv::Point2d at);
void draw_end(Canvas& canvas, cv::Point2d at);

}  // namespace vantage::detail
