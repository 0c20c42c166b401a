// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace vantage::detail {

/// Encodes bytes in base64 (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace vantage::detail
