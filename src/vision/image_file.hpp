// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace vantage::detail {

/// Required pixel format of an image file.
enum class ImageKind : std::uint8_t {
  Depth16,  ///< PNG, one channel of 16 bits
  Grey8,    ///< PNG, JPEG or PNM, converted to 8-bit grey
  Colour8,  ///< PNG, JPEG or PNM, converted to 8-bit blue, green, red
};

/// Reads an image of at most 2^26 pixels. The checksums of a PNG are verified first, so that a damaged file gives a
/// clear error and OpenCV prints nothing. Throws std::runtime_error with the file and the reason.
[[nodiscard]] cv::Mat read_image(const std::filesystem::path& file, ImageKind kind);

}  // namespace vantage::detail
