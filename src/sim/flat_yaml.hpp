// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vantage::detail {

/// The values of each key: one scalar or a list of scalars.
using FlatYaml = std::map<std::string, std::vector<std::string>>;

/// Reads a YAML file of keys with a scalar or a list of scalars each: block ("- 1") or flow ("[1, 2]"), plain or
/// quoted, with comments. Any other YAML is refused. Throws std::runtime_error with the path and the line.
[[nodiscard]] FlatYaml read_flat_yaml(const std::filesystem::path& path);

}  // namespace vantage::detail
