// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vantage/compiler.hpp>
#include <vantage/picture/picture.hpp>

namespace VANTAGE_EXPORT vantage {

/// Reads an image file (PNG, JPEG or PNM) as a colour picture. Throws std::runtime_error with the file and the
/// reason.
[[nodiscard]] Picture read_picture(const std::filesystem::path& file);

}  // namespace vantage
