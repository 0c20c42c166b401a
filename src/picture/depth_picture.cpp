// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vantage/picture/depth_picture.hpp>

#include "picture/canvas.hpp"

namespace vantage {

Picture draw_depth(std::span<const float> depths_m, std::size_t width, double near_m, double far_m) {
  if (!(near_m < far_m) || depths_m.empty() || width == 0 || depths_m.size() % width != 0) {
    throw std::invalid_argument("draw_depth: there must be depths in whole rows, and near_m must be below far_m");
  }
  Picture picture{width, depths_m.size() / width, {}};
  picture.rgb.reserve(3 * depths_m.size());
  for (const float depth_m : depths_m) {
    const double share = std::clamp((depth_m - near_m) / (far_m - near_m), 0.0, 1.0);
    const detail::Colour colour = std::isfinite(depth_m) ? detail::level_colour(1.0 - share) : detail::kUnknownSpace;
    picture.rgb.insert(picture.rgb.end(), {colour.red, colour.green, colour.blue});
  }
  return picture;
}

}  // namespace vantage
