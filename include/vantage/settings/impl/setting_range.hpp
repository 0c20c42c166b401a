// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace vantage::detail {

/// The valid range of a number. An option may be infinite if the range has no bound there; a text only if the default
/// is infinite.
struct SettingRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_itself = true;  ///< false: `least` itself is excluded
  bool most_itself = true;   ///< false: `most` itself is excluded

  [[nodiscard]] bool holds(double value) const {
    return (least_itself ? value >= least : value > least) && (most_itself ? value <= most : value < most);
  }
  /// The range as text for error messages, e.g. "in [0, 1]".
  [[nodiscard]] std::string rule() const;
};

[[nodiscard]] inline SettingRange at_least(double least) { return {least}; }
[[nodiscard]] inline SettingRange more_than(double least) {
  return {least, std::numeric_limits<double>::infinity(), false};
}
[[nodiscard]] inline SettingRange within(double least, double most) { return {least, most}; }

inline std::string SettingRange::rule() const {
  const auto number = [](double value) {
    std::array<char, 64> digits{};
    return std::string(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  };
  if (std::isfinite(most)) {
    return (least_itself ? "in [" : "in (") + number(least) + ", " + number(most) + (most_itself ? "]" : ")");
  }
  return (least_itself ? ">= " : "> ") + number(least);
}

}  // namespace vantage::detail
