// SPDX-License-Identifier: MIT
#include "report/base64.hpp"

#include <cstdint>

namespace vantage::detail {

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t word = at(0) << 16U | at(1) << 8U | at(2);
    text += kDigits[word >> 18U];
    text += kDigits[word >> 12U & 63U];
    text += i + 1 < bytes.size() ? kDigits[word >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? kDigits[word & 63U] : '=';
  }
  return text;
}

}  // namespace vantage::detail
