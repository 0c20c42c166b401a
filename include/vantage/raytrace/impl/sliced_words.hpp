// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/map/impl/instruction_set.hpp>

namespace vantage {

/// Permutes the bits of a word: swaps two binary digits of the index of every bit. This is a transposition.
template <unsigned kLow, unsigned kHigh>
inline std::uint64_t swap_index_bits(std::uint64_t word) {
  constexpr std::uint64_t kMoving = [] {
    std::uint64_t moving = 0;
    for (unsigned bit = 0; bit < 64; ++bit) {
      moving |= (bit >> kLow & 1U) == 1 && (bit >> kHigh & 1U) == 0 ? std::uint64_t{1} << bit : 0;
    }
    return moving;
  }();
  constexpr unsigned kShift = (1U << kHigh) - (1U << kLow);
  const std::uint64_t differing = (word ^ word >> kShift) & kMoving;
  return word ^ differing ^ differing << kShift;
}

/// Reorders the cells of a word (4 x 4 x 4, x fastest) by slices: u fastest, then v, then the major axis.
[[nodiscard]] inline std::uint64_t in_slices(std::uint64_t word, std::size_t major) {
  if (major == 0) {
    word = swap_index_bits<0, 2>(swap_index_bits<1, 3>(word));
  }
  return major == 2 ? word : swap_index_bits<2, 4>(swap_index_bits<3, 5>(word));
}

/// The inverse of `in_slices`.
[[nodiscard]] inline std::uint64_t from_slices(std::uint64_t word, std::size_t major) {
  if (major != 2) {
    word = swap_index_bits<2, 4>(swap_index_bits<3, 5>(word));
  }
  return major == 0 ? swap_index_bits<0, 2>(swap_index_bits<1, 3>(word)) : word;
}

/// The rows of four slices, four rows per slice.
using WordRows = std::array<std::uint32_t, 16>;

/// Converts up to eight adjacent words, ordered by slices (in_slices), to rows of cells. Word i gives the columns 4 i
/// to 4 i + 3.
[[nodiscard]] WordRows rows_of_words(std::span<const std::uint64_t> words, InstructionSet set);

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/sliced_words.ipp>
#endif
