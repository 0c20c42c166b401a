// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vantage/vision/depth_image.hpp>

#include <vantage/settings/impl/option_rule.hpp>
#include "vision/image_file.hpp"

namespace vantage {

std::size_t DepthImage::measured() const {
  return static_cast<std::size_t>(std::count_if(z_m.begin(), z_m.end(), [](float z) { return std::isfinite(z); }));
}

DepthImage read_depth_png(const std::filesystem::path& file, const DepthEncoding& encoding) {
  detail::require_option(std::isfinite(encoding.units_per_m) && encoding.units_per_m > 0.0,
                         "DepthEncoding::units_per_m", encoding.units_per_m, "> 0");
  detail::require_option(encoding.rotated_bits >= 0 && encoding.rotated_bits < 16, "DepthEncoding::rotated_bits",
                         encoding.rotated_bits, "in [0, 15]");
  const cv::Mat image = detail::read_image(file, detail::ImageKind::Depth16);
  DepthImage depth{static_cast<std::size_t>(image.cols), static_cast<std::size_t>(image.rows), {}};
  depth.z_m.reserve(depth.width * depth.height);
  for (int row = 0; row < image.rows; ++row) {
    const auto* numbers = image.ptr<std::uint16_t>(row);
    for (int column = 0; column < image.cols; ++column) {
      const std::uint16_t number = std::rotr(numbers[column], encoding.rotated_bits);
      const bool nothing =
          std::find(encoding.nothing.begin(), encoding.nothing.end(), number) != encoding.nothing.end();
      depth.z_m.push_back(nothing ? std::numeric_limits<float>::quiet_NaN()
                                  : static_cast<float>(number / encoding.units_per_m));
    }
  }
  return depth;
}

}  // namespace vantage
