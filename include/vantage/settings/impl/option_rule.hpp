// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace vantage::detail {

/// Throws std::invalid_argument "OPTION is VALUE, must be RULE" unless `holds`. Name the option as its user writes it
/// ("OccupancyMapOptions::resolution_m", "--resolution"). The value is printed with enough digits to be unique.
template <class Number>
void require_option(bool holds, std::string_view option, Number value, std::string_view rule) {
  static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
  if (holds) {
    return;
  }
  std::array<char, 64> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  throw std::invalid_argument(
      std::string(option).append(" is ").append(digits.data(), end).append(", must be ").append(rule));
}

/// Upper limit on the length of a body, metres. No robot is larger, and such a body is addressable in cells.
inline constexpr double kLongestLengthM = 1000.0;

/// Throws unless a length is in [0, 1000] metres.
inline void require_length(double length_m, std::string_view option) {
  require_option(length_m >= 0.0 && length_m <= kLongestLengthM, option, length_m, "in [0, 1000]");
}

}  // namespace vantage::detail
