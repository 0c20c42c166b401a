// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A colour picture, row by row from the top left; three bytes per pixel: red, green, blue.
struct Picture {
  std::size_t width = 0;          ///< columns
  std::size_t height = 0;         ///< rows
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height bytes
};

/// Writes a PNG file. Throws std::invalid_argument if the picture is empty or its size and data do not match, and
/// std::runtime_error, with the file, if it cannot be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Places pictures side by side, each scaled to `height` rows. Throws std::invalid_argument if there is no picture,
/// one is empty, or the height is 0.
[[nodiscard]] Picture side_by_side(std::span<const Picture> pictures, std::size_t height);

/// Places pictures below each other, each scaled to `width` columns. Errors as side_by_side.
[[nodiscard]] Picture below_each_other(std::span<const Picture> pictures, std::size_t width);

}  // namespace vantage
