// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vantage/geometry/impl/along.hpp>
#include <vantage/raytrace/impl/slice_flood.hpp>
#include <vantage/raytrace/impl/slice_windows.hpp>

namespace vantage::detail {

inline constexpr std::int32_t kRows = SliceWindows::kHeight;
inline constexpr std::int32_t kColumns = SliceWindows::kWidth;

// The rows of a window, padded with empty rows on both sides.
struct PaddedRows {
  alignas(64) std::array<std::uint32_t, 3 * SliceWindows::kHeight> rows{};

  [[nodiscard]] std::uint32_t* first() { return rows.data() + kRows; }
};

constexpr std::uint32_t all_if(bool condition) { return condition ? ~std::uint32_t{0} : 0; }

// Directions in which rays may move to the next cell, per axis: all bits set, or none.
struct Drift {
  std::uint32_t up_u;
  std::uint32_t down_u;
  std::uint32_t up_v;
  std::uint32_t down_v;

  // The cells that one step along u leads to; below, those of a row that one step along v leads to, from the rows on
  // both sides.
  [[nodiscard]] std::uint32_t along_u(std::uint32_t cells) const {
    return (cells << 1U & up_u) | (cells >> 1U & down_u);
  }
  [[nodiscard]] std::uint32_t along_v(const std::uint32_t* row) const { return (row[-1] & up_v) | (row[1] & down_v); }
};

// The way of a beam through the slices of windows. (The arrays hold eight slices to fill vectors; the fifth is used
// as the end of the fourth.)
struct Course {
  template <class T>
  using PerSlice = std::array<T, 8>;

  // Where rays may enter a slice; below, where they may be until they leave it.
  [[nodiscard]] WindowPatch entered(std::size_t slice) const { return {entered_columns[slice], entered_rows[slice]}; }
  [[nodiscard]] WindowPatch passed(std::size_t slice) const { return {passed_columns[slice], passed_rows[slice]}; }

  Drift drift{};
  // The box of interest in the windows: its columns and rows, and a bit for each slice that it overlaps.
  WindowPatch of_box;
  std::uint32_t slices_of_box = 0;
  alignas(32) PerSlice<std::uint32_t> entered_columns{};
  alignas(32) PerSlice<std::uint32_t> entered_rows{};
  alignas(32) PerSlice<std::uint32_t> passed_columns{};
  alignas(32) PerSlice<std::uint32_t> passed_rows{};
};
static_assert(SliceWindows::kMost < std::tuple_size_v<Course::PerSlice<int>>);

// A ray with a slope smaller than this may, after rounding, appear to move in the other direction.
inline constexpr double kStraight = SliceBeam::kRounding;

// Computes the columns and rows in which rays enter and pass the slices of the windows.
inline void place_beam(const SliceBeam& beam, const SliceWindows& windows, InstructionSet set, Course& course) {
  compiled_for(set, [&beam, &course, enters_first = static_cast<double>(windows.first) - beam.from_entry,
                     from_u = beam.within[0] + (beam.first[0] - windows.place.first_u),
                     from_v = beam.within[1] + (beam.first[1] - windows.place.first_v)] {
    constexpr std::int32_t kSlices = std::tuple_size_v<Course::PerSlice<int>>;
    alignas(32) std::array<std::int32_t, kSlices + 1> left;
    alignas(32) std::array<std::int32_t, kSlices + 1> right;
    alignas(32) std::array<std::int32_t, kSlices + 1> top;
    alignas(32) std::array<std::int32_t, kSlices + 1> bottom;
    VANTAGE_INDEPENDENT
#pragma GCC unroll 1
    for (std::int32_t k = 0; k < kSlices; ++k) {
      const double start = enters_first + static_cast<double>(k);
      const double enters = start > 0.0 ? start : 0.0;
      left[static_cast<std::size_t>(k)] = column_at(from_u + beam.least[0] * enters - SliceBeam::kRounding);
      right[static_cast<std::size_t>(k)] = column_at(from_u + beam.most[0] * enters + SliceBeam::kRounding);
      top[static_cast<std::size_t>(k)] = row_at(from_v + beam.least[1] * enters - SliceBeam::kRounding);
      bottom[static_cast<std::size_t>(k)] = row_at(from_v + beam.most[1] * enters + SliceBeam::kRounding);
    }
    // The eighth slice only fills the vectors, so it does not matter where it ends.
    left[kSlices] = left[kSlices - 1];
    right[kSlices] = right[kSlices - 1];
    top[kSlices] = top[kSlices - 1];
    bottom[kSlices] = bottom[kSlices - 1];
    VANTAGE_INDEPENDENT
#pragma GCC unroll 1
    for (std::size_t k = 0; k < kSlices; ++k) {
      course.entered_columns[k] = bits_between(left[k], right[k]);
      course.entered_rows[k] = bits_between(top[k], bottom[k]);
      course.passed_columns[k] = bits_between(left[k] < left[k + 1] ? left[k] : left[k + 1],
                                              right[k] > right[k + 1] ? right[k] : right[k + 1]);
      course.passed_rows[k] = bits_between(top[k] < top[k + 1] ? top[k] : top[k + 1],
                                           bottom[k] > bottom[k + 1] ? bottom[k] : bottom[k + 1]);
    }
  });
}

// Bit mask of the integers in [first, end) that also lie in [0, count).
inline std::uint32_t bits_of_row(std::int32_t first, std::int32_t end, std::int32_t count) {
  first = std::max(first, 0);
  end = std::min(end, count);
  return first < end ? bits_between(first, end - 1) : 0;
}

// Finds the cells of the box in the windows.
inline void place_box(const VoxelBox& box, const SlicePlace& place, Course& course) {
  course.of_box = {
      bits_of_row(along(box.lo, place.u) - place.first_u, along(box.hi, place.u) - place.first_u, kColumns),
      bits_of_row(along(box.lo, place.v) - place.first_v, along(box.hi, place.v) - place.first_v, kRows)};
  const std::int32_t lo = along(box.lo, place.major);
  const std::int32_t hi = along(box.hi, place.major);
  const std::int32_t first = place.along;
  constexpr auto kSlices = static_cast<std::int32_t>(SliceWindows::kMost);
  course.slices_of_box =
      place.up ? bits_of_row(lo - first, hi - first, kSlices) : bits_of_row(first + 1 - hi, first + 1 - lo, kSlices);
}

// Propagates `cells`, in which rays enter the first slice, to the cells in which they leave the last one. `met`
// receives the cells of the box that may stop a ray. Returns whether any ray may be left.
inline bool flood(const SliceWindows& windows, const Course& course, WindowRows& cells, WindowCells& met) {
  PaddedRows padded_open;
  PaddedRows padded_beside;
  std::uint32_t* const open = padded_open.first();
  std::uint32_t* const beside = padded_beside.first();
  std::uint32_t left = 1;
  for (std::size_t k = 0; k < windows.count && left != 0; ++k) {
    const WindowPatch entered = course.entered(k);
    const WindowPatch passed = course.passed(k);
    const WindowPatch of_box = (course.slices_of_box >> k & 1U) != 0 ? course.of_box : WindowPatch{};
    const Drift drift = course.drift;
    const std::uint32_t* const stops = windows.rows[k].data();
    alignas(64) WindowRows hit;
    left = 0;
    // no step, or one along u
    VANTAGE_INDEPENDENT
    for (std::size_t row = 0; row < kRows; ++row) {
      const std::uint32_t here = cells[row] & entered.in_row(row);
      const std::uint32_t goes_on = here & ~stops[row];
      const std::uint32_t along_u = drift.along_u(goes_on) & passed.in_row(row);
      open[row] = goes_on;
      beside[row] = goes_on | (along_u & ~stops[row]);
      hit[row] = (here | along_u) & stops[row];
    }
    // one step along v, alone or after one along u; and one along u after one along v
    VANTAGE_INDEPENDENT
    for (std::size_t row = 0; row < kRows; ++row) {
      const std::uint32_t along_v = drift.along_v(beside + row) & passed.in_row(row);
      const std::uint32_t v_first = drift.along_v(open + row) & passed.in_row(row) & ~stops[row];
      const std::uint32_t all = along_v | (drift.along_u(v_first) & passed.in_row(row));
      met[k][row] = ((all & stops[row]) | hit[row]) & of_box.in_row(row);
      cells[row] = beside[row] | (all & ~stops[row]);
      left |= cells[row];
    }
  }
  return left != 0;
}

#if defined(__x86_64__)

inline constexpr __mmask16 kAllRows = 0xFFFF;

// As Drift, in vector registers.
struct Drift512 {
  __m512i up_u;
  __m512i down_u;
  __m512i up_v;
  __m512i down_v;
};

VANTAGE_TARGET_AVX512 inline __m512i along_u(const Drift512& drift, __m512i cells) {
  return _mm512_or_si512(_mm512_and_si512(_mm512_maskz_slli_epi32(kAllRows, cells, 1), drift.up_u),
                         _mm512_and_si512(_mm512_maskz_srli_epi32(kAllRows, cells, 1), drift.down_u));
}

VANTAGE_TARGET_AVX512 inline __m512i along_v(const Drift512& drift, __m512i cells) {
  const __m512i zero = _mm512_setzero_si512();
  const __m512i up = _mm512_maskz_alignr_epi32(kAllRows, cells, zero, kRows - 1);
  const __m512i down = _mm512_maskz_alignr_epi32(kAllRows, zero, cells, 1);
  return _mm512_or_si512(_mm512_and_si512(up, drift.up_v), _mm512_and_si512(down, drift.down_v));
}

VANTAGE_TARGET_AVX512 inline __m512i without(__m512i cells, __m512i others) {
  return _mm512_maskz_andnot_epi32(kAllRows, others, cells);
}

// As `flood`, with the 16 rows of a window in one register.
VANTAGE_TARGET_AVX512 inline bool flood_avx512(const SliceWindows& windows, const Course& course, WindowRows& rows,
                                               WindowCells& met) {
  const auto all = [](std::uint32_t value) { return static_cast<std::int32_t>(value); };
  const Drift512 drift{_mm512_set1_epi32(all(course.drift.up_u)), _mm512_set1_epi32(all(course.drift.down_u)),
                       _mm512_set1_epi32(all(course.drift.up_v)), _mm512_set1_epi32(all(course.drift.down_v))};
  const __m512i of_box = rows_of(course.of_box);
  __m512i cells = _mm512_loadu_si512(rows.data());
  bool any_left = true;
  for (std::size_t k = 0; k < windows.count && any_left; ++k) {
    const __m512i stops = _mm512_load_si512(windows.rows[k].data());
    const __m512i passed = rows_of(course.passed(k));
    const __m512i here = _mm512_and_si512(cells, rows_of(course.entered(k)));
    const __m512i goes_on = without(here, stops);
    const __m512i by_u = _mm512_and_si512(along_u(drift, goes_on), passed);
    const __m512i beside = _mm512_or_si512(goes_on, without(by_u, stops));
    const __m512i by_v = _mm512_and_si512(along_v(drift, beside), passed);
    const __m512i v_first = without(_mm512_and_si512(along_v(drift, goes_on), passed), stops);
    const __m512i beyond = _mm512_or_si512(by_v, _mm512_and_si512(along_u(drift, v_first), passed));
    const __m512i reached = _mm512_or_si512(_mm512_or_si512(here, by_u), beyond);
    cells = _mm512_or_si512(beside, without(beyond, stops));
    any_left = _mm512_test_epi32_mask(cells, cells) != 0;
    const __m512i counted = (course.slices_of_box >> k & 1U) != 0 ? of_box : _mm512_setzero_si512();
    _mm512_storeu_si512(met[k].data(), _mm512_and_si512(_mm512_and_si512(reached, stops), counted));
  }
  _mm512_storeu_si512(rows.data(), cells);
  return any_left;
}

#endif

VANTAGE_INLINE bool SliceFlood::begin(const SliceBeam& beam) {
  // A steeper ray may, after rounding, appear to cross two faces of the same axis in one slice.
  constexpr double kMostAskew = 1.0 - 1e-5;
  beam_ = beam;
  is_full_ = true;
  return beam.least[0] >= -kMostAskew && beam.most[0] <= kMostAskew && beam.least[1] >= -kMostAskew &&
         beam.most[1] <= kMostAskew;
}

// Moves the set of cells to the first of these windows. Between the slices the set grows by the
// spread of the beam.
VANTAGE_INLINE void SliceFlood::move(const SliceWindows& windows) {
  const SlicePlace& place = windows.place;
  const std::array<std::int32_t, 2> before{std::exchange(first_u_, place.first_u),
                                           std::exchange(first_v_, place.first_v)};
  if (is_full_) {
    cells_.fill(~std::uint32_t{0});
    return;
  }
  const auto gap = static_cast<double>(windows.first - slice_);
  std::array<std::int32_t, 2> least{before[0] - place.first_u, before[1] - place.first_v};
  std::array<std::int32_t, 2> most = least;
  for (std::size_t i = 0; i < 2; ++i) {
    if (gap > 0.0) {
      least[i] += SliceBeam::cell_at(beam_.least[i] * gap - SliceBeam::kRounding);
      most[i] += SliceBeam::cell_at(beam_.most[i] * gap + SliceBeam::kRounding) + 1;
    }
  }
  // The set of all cells is a bound, too, and cheaper than one that spreads far.
  constexpr std::int32_t kWidest = 8;
  if (most[0] - least[0] >= kWidest || most[1] - least[1] >= kWidest) {
    cells_.fill(~std::uint32_t{0});
    return;
  }
  PaddedRows moved;
  std::uint32_t* const rows = moved.first();
  compiled_for(set_, [this, rows, least, most] {
    for (std::int32_t by = std::max(least[0], -kColumns + 1); by <= std::min(most[0], kColumns - 1); ++by) {
      const auto up = static_cast<unsigned>(std::max(by, 0));
      const auto down = static_cast<unsigned>(std::max(-by, 0));
      VANTAGE_INDEPENDENT
      for (std::size_t row = 0; row < kRows; ++row) {
        rows[row] |= cells_[row] << up >> down;
      }
    }
    cells_.fill(0);
    for (std::int32_t by = std::max(least[1], -kRows); by <= std::min(most[1], kRows); ++by) {
      const std::uint32_t* const from = rows - by;
      VANTAGE_INDEPENDENT
      for (std::size_t row = 0; row < kRows; ++row) {
        cells_[row] |= from[row];
      }
    }
  });
}

VANTAGE_INLINE bool SliceFlood::pass(const SliceWindows& windows, WindowCells& met) {
  move(windows);
  is_full_ = false;
  slice_ = windows.first + static_cast<std::int64_t>(windows.count);
  Course course;
  met = {};
  course.drift = {all_if(beam_.most[0] > -kStraight), all_if(beam_.least[0] < kStraight),
                  all_if(beam_.most[1] > -kStraight), all_if(beam_.least[1] < kStraight)};
  place_beam(beam_, windows, set_, course);
  place_box(box_, windows.place, course);
#if defined(__x86_64__)
  if (set_ == InstructionSet::Avx512) {
    return flood_avx512(windows, course, cells_, met);
  }
#endif
  bool any_left = false;
  compiled_for(set_, [&] { any_left = flood(windows, course, cells_, met); });
  return any_left;
}

}  // namespace vantage::detail
