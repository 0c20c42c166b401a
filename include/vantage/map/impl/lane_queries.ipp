// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <vantage/map/impl/lane_queries.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage::detail {

inline constexpr double kLarge = std::numeric_limits<double>::max();

#if defined(__x86_64__)

VANTAGE_TARGET_AVX512 inline std::uint64_t equal_avx512(const RayBlock::PerRay<std::int32_t>& values,
                                                        std::int32_t value) {
  std::uint64_t equal = 0;
  for (std::size_t first = 0; first < values.size(); first += 16) {
    const __m512i some = _mm512_loadu_si512(&values[first]);
    equal |= std::uint64_t{_mm512_cmpeq_epi32_mask(some, _mm512_set1_epi32(value))} << first;
  }
  return equal;
}

VANTAGE_TARGET_AVX512 inline std::uint64_t changes_avx512(const RayBlock::PerRay<std::int32_t>& values) {
  std::uint64_t changes = 1;
  for (const std::size_t first : {0U, 16U, 32U, 47U}) {  // the last sixteen pairs overlap with those before
    const __m512i some = _mm512_loadu_si512(&values[first]);
    const __m512i next = _mm512_loadu_si512(&values[first + 1]);
    changes |= std::uint64_t{_mm512_cmpneq_epi32_mask(some, next)} << (first + 1);
  }
  return changes;
}

VANTAGE_TARGET_AVX512 inline std::pair<double, double> range_avx512(const RayBlock::PerRay<double>& values,
                                                                    std::uint64_t active) {
  __m512d least = _mm512_set1_pd(kLarge);
  __m512d most = _mm512_set1_pd(-kLarge);
  for (std::size_t first = 0; first < values.size(); first += 8) {
    const __m512d eight = _mm512_loadu_pd(&values[first]);
    const auto some = static_cast<__mmask8>(active >> first);
    least = _mm512_mask_min_pd(least, some, least, eight);
    most = _mm512_mask_max_pd(most, some, most, eight);
  }
  constexpr __mmask8 kFour = 15;
  const __m256d low =
      _mm256_min_pd(_mm512_maskz_extractf64x4_pd(kFour, least, 0), _mm512_maskz_extractf64x4_pd(kFour, least, 1));
  const __m256d high =
      _mm256_max_pd(_mm512_maskz_extractf64x4_pd(kFour, most, 0), _mm512_maskz_extractf64x4_pd(kFour, most, 1));
  const __m128d two_low = _mm_min_pd(_mm256_castpd256_pd128(low), _mm256_extractf128_pd(low, 1));
  const __m128d two_high = _mm_max_pd(_mm256_castpd256_pd128(high), _mm256_extractf128_pd(high, 1));
  return {_mm_cvtsd_f64(_mm_min_sd(two_low, _mm_unpackhi_pd(two_low, two_low))),
          _mm_cvtsd_f64(_mm_max_sd(two_high, _mm_unpackhi_pd(two_high, two_high)))};
}

VANTAGE_TARGET_AVX2 inline std::pair<double, double> range_avx2(const RayBlock::PerRay<double>& values,
                                                                std::uint64_t active) {
  const __m256i each = _mm256_setr_epi64x(1, 2, 4, 8);
  __m256d least = _mm256_set1_pd(kLarge);
  __m256d most = _mm256_set1_pd(-kLarge);
  for (std::size_t first = 0; first < values.size(); first += 4) {
    const __m256d four = _mm256_loadu_pd(&values[first]);
    const __m256i bit = _mm256_and_si256(_mm256_set1_epi64x(static_cast<std::int64_t>(active >> first)), each);
    const __m256d some = _mm256_castsi256_pd(_mm256_cmpeq_epi64(bit, each));
    least = _mm256_min_pd(least, _mm256_blendv_pd(least, four, some));
    most = _mm256_max_pd(most, _mm256_blendv_pd(most, four, some));
  }
  alignas(32) std::array<double, 4> lows;
  alignas(32) std::array<double, 4> highs;
  _mm256_store_pd(lows.data(), least);
  _mm256_store_pd(highs.data(), most);
  return {*std::min_element(lows.begin(), lows.end()), *std::max_element(highs.begin(), highs.end())};
}

VANTAGE_TARGET_AVX2 inline std::uint64_t equal_avx2(const RayBlock::PerRay<std::int32_t>& values,
                                                    std::int32_t value) {
  std::uint64_t equal = 0;
  for (std::size_t first = 0; first < values.size(); first += 8) {
    const __m256i some = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&values[first]));
    const __m256i same = _mm256_cmpeq_epi32(some, _mm256_set1_epi32(value));
    const auto equals = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(same)));
    equal |= std::uint64_t{equals} << first;
  }
  return equal;
}

VANTAGE_TARGET_AVX2 inline std::uint64_t changes_avx2(const RayBlock::PerRay<std::int32_t>& values) {
  std::uint64_t changes = 1;
  // the last eight pairs overlap with those before
  for (const std::size_t first : {0U, 8U, 16U, 24U, 32U, 40U, 48U, 55U}) {
    const __m256i some = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&values[first]));
    const __m256i next = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&values[first + 1]));
    const auto same = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(some, next))));
    changes |= std::uint64_t{~same & 255U} << (first + 1);
  }
  return changes;
}

#endif

VANTAGE_INLINE std::uint64_t equal_to(const RayBlock::PerRay<std::int32_t>& values, std::int32_t value,
                                      InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return equal_avx512(values, value);
  }
  if (set == InstructionSet::Avx2) {
    return equal_avx2(values, value);
  }
#endif
  (void)set;
  std::uint64_t equal = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    equal |= static_cast<std::uint64_t>(values[i] == value) << i;
  }
  return equal;
}

VANTAGE_INLINE std::uint64_t changes_of(const RayBlock::PerRay<std::int32_t>& values, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return changes_avx512(values);
  }
  if (set == InstructionSet::Avx2) {
    return changes_avx2(values);
  }
#endif
  (void)set;
  std::uint64_t changes = 1;
  for (std::size_t i = 1; i < values.size(); ++i) {
    changes |= static_cast<std::uint64_t>(values[i] != values[i - 1]) << i;
  }
  return changes;
}

VANTAGE_INLINE std::pair<double, double> range_of(const RayBlock::PerRay<double>& values, std::uint64_t active,
                                                  InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return range_avx512(values, active);
  }
  if (set == InstructionSet::Avx2) {
    return range_avx2(values, active);
  }
#endif
  (void)set;
  std::pair<double, double> range{kLarge, -kLarge};
  for (; active != 0; active &= active - 1) {
    const double value = values[static_cast<std::size_t>(std::countr_zero(active))];
    range.first = std::min(range.first, value);
    range.second = std::max(range.second, value);
  }
  return range;
}

}  // namespace vantage::detail
