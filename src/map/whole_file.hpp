// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace vantage::detail {

/// Writes a file so that its name holds all of `bytes` or what it held before: they go to NAME.part, which takes the
/// name once it is whole. A device or a pipe is written to as it is. Throws std::runtime_error with the path and the
/// system's reason; then there is no NAME.part.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

/// Whether such a file could be begun: throws as `write_whole_file` does. Leaves nothing behind.
void try_whole_file(const std::filesystem::path& path);

}  // namespace vantage::detail
