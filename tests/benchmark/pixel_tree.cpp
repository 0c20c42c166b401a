// SPDX-License-Identifier: MIT
#include <benchmark/pixel_tree.hpp>

namespace vantage {

PixelTree::PixelTree(const RangeSensor& camera, int levels) : levels_(static_cast<std::size_t>(levels)) {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const std::size_t share = std::size_t{1} << (levels_.size() - 1 - i);
    const std::size_t width = camera.width / share;
    const std::size_t height = camera.height / share;
    levels_[i].image = {width, height,
                        RangeSensor::pinhole(width, height, camera.horizontal_angle_rad(),
                                             camera.vertical_angle_rad(), 0.0, camera.max_range_m)
                            .directions()};
    levels_[i].leaves = static_cast<std::uint32_t>(share * share);
  }
  for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
    const RayImage& above = levels_[i].image;
    for (std::size_t ray = 0; ray < above.directions.size(); ++ray) {
      const std::size_t first = ray / above.width * 4 * above.width + ray % above.width * 2;
      const auto left = static_cast<std::uint32_t>(first);
      const auto below = static_cast<std::uint32_t>(first + 2 * above.width);
      levels_[i].children.push_back({left, left + 1, below, below + 1});
    }
  }
}

}  // namespace vantage
