// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/replay.hpp"

namespace vantage::detail {

/// A replay as the page reads it: numbers as JSON; lists of cells as columns of 16-bit little endian numbers,
/// packed by deflate, in base64.
[[nodiscard]] nlohmann::json replay_json(const Replay& replay);

}  // namespace vantage::detail
