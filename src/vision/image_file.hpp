// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace vantage::detail {

/// How an image file is to be read.
enum class ImageKind : std::uint8_t {
  Depth16,  ///< PNG, one channel of 16 bits
  Grey8,    ///< PNG, JPEG or PNM, as brightness of 8 bits
  Colour8,  ///< likewise, as blue, green, red of 8 bits
};

/// Reads an image of at most 2^26 pixels. A PNG is looked through first, chunk by chunk with their check sums, so
/// that a damaged file is refused in words of our own and nothing is printed. Throws std::runtime_error with the file
/// and what is wrong.
[[nodiscard]] cv::Mat read_image(const std::filesystem::path& file, ImageKind kind);

}  // namespace vantage::detail
