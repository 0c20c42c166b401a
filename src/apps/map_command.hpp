// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vantage::apps {

/// What `vantage map` tells of an OctoMap file: its name, resolution, counts of cells by kind, the bounds of its
/// known cells (lower corner, then upper), and the memory its map takes here, in 10^6 bytes.
[[nodiscard]] nlohmann::json map_summary(const std::filesystem::path& file);

/// `vantage map FILE [--json FILE|-]`: prints the summary of `file` to `out`, as JSON where `json` is "-", and writes
/// it to the file `json` where it is another name. Returns the exit code 0; throws std::runtime_error for bad input.
int run_map_command(const std::filesystem::path& file, const std::string& json, std::ostream& out);

}  // namespace vantage::apps
