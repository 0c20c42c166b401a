// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vantage/compiler.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// A colour picture: rows from the top, pixels from the left, three bytes each (red, green, blue).
struct Picture {
  std::size_t width = 0;          ///< columns
  std::size_t height = 0;         ///< rows
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height bytes
};

/// Writes `picture` as a PNG file. Throws std::invalid_argument if the picture is empty or its bytes do not fit its
/// size, std::runtime_error naming the file if it cannot be written.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// The pictures side by side, each scaled to `height` rows. Throws std::invalid_argument if there is none, one is
/// empty or the height is 0.
[[nodiscard]] Picture side_by_side(std::span<const Picture> pictures, std::size_t height);

/// The pictures one below the other, each scaled to `width` columns. Errors as side_by_side.
[[nodiscard]] Picture below_each_other(std::span<const Picture> pictures, std::size_t width);

/// Reads a picture file, PNG or JPEG, as colour. Throws std::runtime_error with the file and what is wrong with it.
[[nodiscard]] Picture read_picture(const std::filesystem::path& file);

}  // namespace vantage
