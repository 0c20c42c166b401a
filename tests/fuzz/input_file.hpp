// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>

#include "temporary_path.hpp"

namespace vantage::fuzz {

/// A temporary file with these bytes, for readers that accept only files.
class InputFile : public TemporaryPath {
 public:
  InputFile(const std::uint8_t* data, std::size_t size, const std::string& ending) : TemporaryPath(ending) {
    std::ofstream(path(), std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
};

}  // namespace vantage::fuzz
