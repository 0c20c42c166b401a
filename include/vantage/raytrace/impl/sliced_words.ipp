// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/raytrace/impl/sliced_words.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage {
namespace detail {

#if defined(__x86_64__)

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

VANTAGE_TARGET_AVX2 inline WordRows rows_avx2(std::span<const std::uint64_t> words) {
  const __m256i from = _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28);
  const __m256i mask = _mm256_set1_epi32(15);
  __m256i low = _mm256_setzero_si256();
  __m256i high = _mm256_setzero_si256();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const __m256i halves = _mm256_set1_epi32(static_cast<std::int32_t>(words[i]));
    const __m256i others = _mm256_set1_epi32(static_cast<std::int32_t>(words[i] >> 32U));
    const __m128i columns = _mm_cvtsi32_si128(static_cast<std::int32_t>(4 * i));
    low = _mm256_or_si256(low, _mm256_sll_epi32(_mm256_and_si256(_mm256_srlv_epi32(halves, from), mask), columns));
    high = _mm256_or_si256(high, _mm256_sll_epi32(_mm256_and_si256(_mm256_srlv_epi32(others, from), mask), columns));
  }
  WordRows all;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(all.data()), low);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(&all[8]), high);
  return all;
}

#endif

}  // namespace detail

VANTAGE_INLINE WordRows rows_of_words(std::span<const std::uint64_t> words, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return detail::rows_avx512(words);
  }
  if (set == InstructionSet::Avx2) {
    return detail::rows_avx2(words);
  }
#endif
  (void)set;
  WordRows all{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (std::size_t row = 0; row < all.size(); ++row) {
      all[row] |= static_cast<std::uint32_t>(words[i] >> 4U * row & 15U) << 4U * i;
    }
  }
  return all;
}

}  // namespace vantage
