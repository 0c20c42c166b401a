// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vantage::detail {

/// A grey image; row 0 is at the top.
struct PgmImage {
  std::int32_t width = 0;
  std::int32_t height = 0;
  double brightest = 255.0;
  std::vector<std::uint16_t> values;

  /// Brightness of a pixel, in [0, 1].
  [[nodiscard]] double bright(std::int32_t column, std::int32_t row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)] /
           brightest;
  }
};

/// Reads a PGM file, plain (P2) or binary (P5), 8 or 16 bits. The announced size is compared with the size of the
/// file before memory is allocated. Throws std::runtime_error with the path and the error.
[[nodiscard]] PgmImage read_pgm(const std::filesystem::path& path);

}  // namespace vantage::detail
