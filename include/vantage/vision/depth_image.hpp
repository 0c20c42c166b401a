// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// An image of depths along the optical axis, row by row from the top left.
struct DepthImage {
  std::size_t width = 0;        ///< columns
  std::size_t height = 0;       ///< rows
  std::vector<float> z_m = {};  ///< width * height depths, metres; NaN if not measured

  /// Depth of a pixel, metres.
  [[nodiscard]] float at(std::size_t column, std::size_t row) const { return z_m[row * width + column]; }
  /// The number of measured pixels.
  [[nodiscard]] std::size_t measured() const;
};

/// How 16-bit values in a file encode depths.
struct DepthEncoding {
  double units_per_m = 1000.0;  ///< units per metre, > 0: 1000 for millimetres, 5000 in the TUM format
  std::vector<std::uint16_t> nothing = {0, 65535};  ///< values that mean "not measured"
  /// Number of bits, in [0, 15], by which every value was rotated to the left; some drivers do this.
  int rotated_bits = 0;
};

/// Reads a 16-bit, single-channel PNG file. Throws std::invalid_argument for an invalid encoding, and
/// std::runtime_error, with the file and the reason, if the file is missing, not a PNG, truncated, damaged, or has
/// another format.
[[nodiscard]] DepthImage read_depth_png(const std::filesystem::path& file, const DepthEncoding& encoding = {});

}  // namespace vantage
