// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/raytrace/impl/sliced_words.hpp>

namespace vantage {

VANTAGE_INLINE WordRows rows_of_words(std::span<const std::uint64_t> words, InstructionSet set) {
  WordRows all{};
  compiled_for(set, [words, rows = all.data()] {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto low = static_cast<std::uint32_t>(words[i]);
      const auto high = static_cast<std::uint32_t>(words[i] >> 32U);
      for (std::size_t row = 0; row < 8; ++row) {
        rows[row] |= (low >> 4U * row & 15U) << 4U * i;
        rows[row + 8] |= (high >> 4U * row & 15U) << 4U * i;
      }
    }
  });
  return all;
}

}  // namespace vantage
