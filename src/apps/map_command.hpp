// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vantage::apps {

/// Summary of an OctoMap file: name, resolution, counts of cells by kind, bounds of the known cells (lower, upper
/// corner), and the memory of the map here, in 10^6 bytes. Throws std::runtime_error for bad input, and if the map
/// needs more than `max_bytes` (0: no limit).
[[nodiscard]] nlohmann::json map_summary(const std::filesystem::path& file, std::size_t max_bytes = 0);

/// Runs `vantage map FILE [--json FILE|-] [--memory-limit MB]`: prints the summary to `out`, as JSON if `json` is
/// "-", and writes it to the file `json` if that is another name. Returns the exit code 0. Errors as `map_summary`.
int run_map_command(const std::filesystem::path& file, const std::string& json, std::ostream& out,
                    std::size_t max_bytes = 0);

}  // namespace vantage::apps
