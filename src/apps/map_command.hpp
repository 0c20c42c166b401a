// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vantage::apps {

/// Summary of an OctoMap file: name, resolution, counts of cells by kind, bounds of the known cells (lower, upper
/// corner), and the memory of the map here, in 10^6 bytes.
[[nodiscard]] nlohmann::json map_summary(const std::filesystem::path& file);

/// Runs `vantage map FILE [--json FILE|-]`: prints the summary to `out`, as JSON if `json` is "-", and writes it
/// to the file `json` if that is another name. Returns the exit code 0. Throws std::runtime_error for bad input.
int run_map_command(const std::filesystem::path& file, const std::string& json, std::ostream& out);

}  // namespace vantage::apps
