// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace vantage::detail {

/// Parses "x,y,...", finite numbers with nothing but commas between them; empty if the text has another form.
[[nodiscard]] inline std::vector<double> number_list(std::string_view text) {
  std::vector<double> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data();; ++at) {
    const auto [after, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc{} || !std::isfinite(numbers.back()) || (after != end && *after != ',')) {
      return {};
    }
    if (after == end) {
      return numbers;
    }
    at = after;
  }
}

}  // namespace vantage::detail
