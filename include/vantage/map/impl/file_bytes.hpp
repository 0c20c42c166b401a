// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

// Header-only, because every component reads files with it and exports no symbols for it.
namespace vantage::detail {

/// The bytes of a file, or of a pipe up to its end. Throws std::runtime_error with the path if it cannot be opened or
/// holds more than `most_bytes`: neither a wrong file nor an endless one fills the memory.
[[nodiscard]] inline std::string file_bytes(const std::filesystem::path& path, std::size_t most_bytes) {
  std::ifstream in(path, std::ios::binary);
  std::error_code none;
  if (!in || std::filesystem::is_directory(path, none)) {
    throw std::runtime_error(path.string() + ": cannot be opened");
  }
  std::string bytes;
  std::array<char, 1U << 14U> part{};
  while (in.read(part.data(), part.size()) || in.gcount() > 0) {
    bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > most_bytes) {
      throw std::runtime_error(path.string() + ": holds more than " + std::to_string(most_bytes) +
                               " bytes, which no file of this kind does");
    }
  }
  return bytes;
}

}  // namespace vantage::detail
