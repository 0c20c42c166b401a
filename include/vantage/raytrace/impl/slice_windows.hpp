// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/map/impl/slice_beam.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage {

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

}  // namespace vantage
