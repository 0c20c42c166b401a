// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "report/replay.hpp"

namespace vantage::detail {

/// RFC 4648.
[[nodiscard]] std::string base64(std::string_view bytes);

/// A replay as the page reads it: numbers as JSON, lists of cells as columns of 16-bit numbers, lowest byte first,
/// packed by deflate, in base64.
[[nodiscard]] nlohmann::json replay_json(const Replay& replay);

}  // namespace vantage::detail
