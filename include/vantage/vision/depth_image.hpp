// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/vision/picture.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Distances along the optical axis: rows from the top, pixels from the left.
struct DepthImage {
  std::size_t width = 0;        ///< columns
  std::size_t height = 0;       ///< rows
  std::vector<float> z_m = {};  ///< width * height of them, metres; NaN where nothing was measured

  /// The value of a pixel.
  [[nodiscard]] float at(std::size_t column, std::size_t row) const { return z_m[row * width + column]; }
  /// How many pixels were measured.
  [[nodiscard]] std::size_t measured() const;
};

/// How 16-bit numbers in a file stand for distances.
struct DepthEncoding {
  double units_per_m = 1000.0;                      ///< 1000 for millimetres, 5000 in the TUM format; > 0
  std::vector<std::uint16_t> nothing = {0, 65535};  ///< numbers that say "not measured"
  /// How many bits every number was rotated to the left before it was written, in [0, 15]; some drivers do.
  int rotated_bits = 0;
};

/// Reads a PNG file of one channel of 16 bits. Throws std::invalid_argument for a wrong encoding, std::runtime_error
/// with the file and what is wrong with it: missing, no PNG, cut off, a bad check sum, another depth of bits.
[[nodiscard]] DepthImage read_depth_png(const std::filesystem::path& file, const DepthEncoding& encoding = {});

/// The image in colours, near ones light, what was not measured grey. Distances below `near_m` or above `far_m` are
/// drawn as these. Throws std::invalid_argument unless near_m < far_m and the image has a pixel.
[[nodiscard]] Picture draw_depth(const DepthImage& depth, double near_m, double far_m);

}  // namespace vantage
