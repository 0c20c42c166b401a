// SPDX-License-Identifier: MIT
#include <vantage/vision/read_picture.hpp>

#include "vision/image_file.hpp"

namespace vantage {

Picture read_picture(const std::filesystem::path& file) {
  const cv::Mat bgr = detail::read_image(file, detail::ImageKind::Colour8);
  Picture picture{static_cast<std::size_t>(bgr.cols), static_cast<std::size_t>(bgr.rows), {}};
  picture.rgb.reserve(3 * picture.width * picture.height);
  for (int row = 0; row < bgr.rows; ++row) {
    for (int column = 0; column < bgr.cols; ++column) {
      const auto& pixel = bgr.at<cv::Vec3b>(row, column);
      picture.rgb.insert(picture.rgb.end(), {pixel[2], pixel[1], pixel[0]});
    }
  }
  return picture;
}

}  // namespace vantage
