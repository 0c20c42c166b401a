// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vantage::detail {

/// A grey picture, rows from the top.
struct PgmImage {
  std::int32_t width = 0;
  std::int32_t height = 0;
  double brightest = 255.0;
  std::vector<std::uint16_t> values;

  /// Of a pixel, in [0, 1].
  [[nodiscard]] double bright(std::int32_t column, std::int32_t row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)] /
           brightest;
  }
};

/// Reads a PGM file, plain (P2) or binary (P5), of 8 or 16 bits. What it says of its size is held to the size of the
/// file before anything is allocated. Throws std::runtime_error naming the file and what is wrong.
[[nodiscard]] PgmImage read_pgm(const std::filesystem::path& path);

}  // namespace vantage::detail
