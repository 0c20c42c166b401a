// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/instruction_set.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage {

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

}  // namespace vantage
