// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vantage/picture/picture.hpp>

#include <vantage/map/impl/whole_file.hpp>

namespace vantage {
namespace {

bool is_whole(const Picture& picture) {
  return picture.width > 0 && picture.height > 0 && picture.rgb.size() == 3 * picture.width * picture.height;
}

// A view of the same bytes, without a copy. OpenCV only reads them.
cv::Mat mat_of(const Picture& picture) {
  return {static_cast<int>(picture.height), static_cast<int>(picture.width), CV_8UC3,
          const_cast<std::uint8_t*>(picture.rgb.data())};  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

void check_pictures(const char* what, std::span<const Picture> pictures, std::size_t size) {
  if (pictures.empty() || size == 0 || !std::all_of(pictures.begin(), pictures.end(), is_whole)) {
    throw std::invalid_argument(std::string(what) + ": there must be pictures, none of them empty, and a size");
  }
}

// Rounding is the same for all pictures, so scaled pictures share one side length.
cv::Mat scaled_by(const Picture& picture, double scale) {
  const auto side = [scale](std::size_t pixels) {
    return std::max(1, static_cast<int>(std::lround(scale * static_cast<double>(pixels))));
  };
  cv::Mat scaled;
  cv::resize(mat_of(picture), scaled, cv::Size(side(picture.width), side(picture.height)), 0.0, 0.0,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return scaled;
}

// Scales all pictures so that this side has the given length.
std::vector<cv::Mat> scaled_alike(const char* what, std::span<const Picture> pictures, std::size_t Picture::*side,
                                  std::size_t length) {
  check_pictures(what, pictures, length);
  std::vector<cv::Mat> scaled;
  for (const Picture& picture : pictures) {
    scaled.push_back(scaled_by(picture, static_cast<double>(length) / static_cast<double>(picture.*side)));
  }
  return scaled;
}

Picture picture_of(const cv::Mat& rgb) {
  return {static_cast<std::size_t>(rgb.cols), static_cast<std::size_t>(rgb.rows), {rgb.datastart, rgb.dataend}};
}

}  // namespace

void write_png(const Picture& picture, const std::filesystem::path& file) {
  if (picture.width == 0 || picture.height == 0 || picture.rgb.size() != 3 * picture.width * picture.height) {
    throw std::invalid_argument("Picture::rgb has " + std::to_string(picture.rgb.size()) + " bytes, must be 3 * " +
                                std::to_string(picture.width) + " * " + std::to_string(picture.height) +
                                " and not 0");
  }
  cv::Mat bgr(static_cast<int>(picture.height), static_cast<int>(picture.width), CV_8UC3);
  for (std::size_t pixel = 0; pixel < picture.width * picture.height; ++pixel) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      bgr.data[3 * pixel + channel] = picture.rgb[3 * pixel + 2 - channel];
    }
  }
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", bgr, bytes)) {
    throw std::runtime_error(file.string() + ": the picture cannot be encoded as PNG");
  }
  detail::write_whole_file(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

Picture side_by_side(std::span<const Picture> pictures, std::size_t height) {
  cv::Mat row;
  cv::hconcat(scaled_alike("side_by_side", pictures, &Picture::height, height), row);
  return picture_of(row);
}

Picture below_each_other(std::span<const Picture> pictures, std::size_t width) {
  cv::Mat column;
  cv::vconcat(scaled_alike("below_each_other", pictures, &Picture::width, width), column);
  return picture_of(column);
}

}  // namespace vantage
