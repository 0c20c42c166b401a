// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/map/impl/slice_beam.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage::detail {

/// Position of the windows of a few slices in the map.
struct SlicePlace : SliceAxes {
  std::int32_t along = 0;    ///< coordinate of the first slice along the major axis
  std::int32_t first_u = 0;  ///< coordinate of the first column of the windows, a multiple of 4
  std::int32_t first_v = 0;  ///< coordinate of the first row of the windows, a multiple of 4
};

/// Windows of up to four consecutive slices. A window is a part of a slice with 32 x 16 cells; a set bit is a cell
/// that stops rays.
struct SliceWindows {
  static constexpr std::int32_t kWidth = 32;   ///< cells along the first lateral axis, u
  static constexpr std::int32_t kHeight = 16;  ///< cells along the second lateral axis, v
  static constexpr std::size_t kMost = 4;      ///< maximum number of slices

  alignas(64) std::array<std::array<std::uint32_t, kHeight>, kMost> rows{};  ///< rows[slice][v], bit u
  std::size_t count = 0;   ///< number of slices, in the order of the walk
  std::int64_t first = 0;  ///< number of the first slice
  SlicePlace place;
};

/// A set of cells of one window, and of the windows of all slices.
using WindowRows = std::array<std::uint32_t, SliceWindows::kHeight>;
using WindowCells = std::array<WindowRows, SliceWindows::kMost>;

/// Bit mask of the integers from `lo` to `hi`, both in [0, 31].
constexpr std::uint32_t bits_between(std::int32_t lo, std::int32_t hi) {
  return ~std::uint32_t{0} << lo & ~std::uint32_t{0} >> (31 - hi);
}

/// A rectangle of cells of a window, as a bit mask of its columns and one of its rows.
struct WindowPatch {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  /// The columns of the rectangle in a row; 0 if the row is outside.
  [[nodiscard]] std::uint32_t in_row(std::size_t row) const { return columns & (0U - (rows >> row & 1U)); }
};

/// The column, and below the row, of a position in a window, clamped to the window.
inline std::int32_t column_at(double place) {
  const double no_less = place > 0.0 ? place : 0.0;
  return static_cast<std::int32_t>(no_less < SliceWindows::kWidth - 0.5 ? no_less : SliceWindows::kWidth - 0.5);
}
inline std::int32_t row_at(double place) {
  const double no_less = place > 0.0 ? place : 0.0;
  return static_cast<std::int32_t>(no_less < SliceWindows::kHeight - 0.5 ? no_less : SliceWindows::kHeight - 0.5);
}

#if defined(__x86_64__)
/// A patch as a vector of 16 rows.
VANTAGE_TARGET_AVX512 inline __m512i rows_of(const WindowPatch& patch) {
  return _mm512_maskz_set1_epi32(static_cast<__mmask16>(patch.rows), static_cast<std::int32_t>(patch.columns));
}
#endif

#if defined(__x86_64__)
VANTAGE_TARGET_AVX512 inline std::uint32_t slices_with_avx512(const WindowPatch& patch, const WindowCells& cells) {
  const __m512i of_patch = rows_of(patch);
  std::uint32_t slices = 0;
  for (std::size_t slice = 0; slice < cells.size(); ++slice) {
    const bool any = _mm512_test_epi32_mask(_mm512_load_si512(cells[slice].data()), of_patch) != 0;
    slices |= std::uint32_t{any} << slice;
  }
  return slices;
}
#endif

/// A bit for each slice that holds any of these cells inside the patch.
[[nodiscard]] inline std::uint32_t slices_with(const WindowPatch& patch, const WindowCells& cells,
                                               InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return slices_with_avx512(patch, cells);
  }
#endif
  (void)set;
  std::uint32_t slices = 0;
  for (std::size_t slice = 0; slice < cells.size(); ++slice) {
    std::uint32_t any = 0;
    for (std::size_t row = 0; row < cells[slice].size(); ++row) {
      any |= cells[slice][row] & patch.in_row(row);
    }
    slices |= std::uint32_t{any != 0} << slice;
  }
  return slices;
}

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

#if defined(__x86_64__)
// A word holds 16 rows of four cells, one for each lane: lanes 0 to 7 take them from its lower half, lanes 8 to 15
// from its upper half.
VANTAGE_TARGET_AVX512 inline WordRows rows_avx512(std::span<const std::uint64_t> words) {
  const __m512i from = _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 0, 4, 8, 12, 16, 20, 24, 28);
  __m512i rows = _mm512_setzero_si512();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const __m256i low = _mm256_set1_epi32(static_cast<std::int32_t>(words[i]));
    const __m256i high = _mm256_set1_epi32(static_cast<std::int32_t>(words[i] >> 32U));
    const __m512i halves = _mm512_maskz_inserti64x4(0xFF, _mm512_castsi256_si512(low), high, 1);
    const __m512i cells = _mm512_and_si512(_mm512_maskz_srlv_epi32(0xFFFF, halves, from), _mm512_set1_epi32(15));
    const __m128i columns = _mm_cvtsi32_si128(static_cast<std::int32_t>(4 * i));
    rows = _mm512_or_si512(rows, _mm512_maskz_sll_epi32(0xFFFF, cells, columns));
  }
  WordRows all;
  _mm512_storeu_si512(all.data(), rows);
  return all;
}
#endif

/// Converts up to eight adjacent words, ordered by slices (in_slices), to rows of cells. Word i gives the columns 4 i
/// to 4 i + 3.
[[nodiscard]] inline WordRows rows_of_words(std::span<const std::uint64_t> words, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return rows_avx512(words);
  }
#endif
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

}  // namespace vantage::detail
