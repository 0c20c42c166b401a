// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/ray_lanes.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage::detail {

inline void mark(std::uint64_t* plane, std::int64_t position) {
  plane[position >> 6] |= std::uint64_t{1} << (position & 63);
}

// Walks one lane after the other. This is the reference for the vectorised versions below, and the fallback without
// them.
inline void walk_baseline(RayLanes& lanes, std::int64_t steps, std::uint64_t* plane) {
  const auto [mask_x, mask_y, mask_z] = lanes.mask;
  for (std::size_t lane = 0; lane < RayLanes::kLanes; ++lane) {
    std::int64_t x = lanes.next[0][lane];
    std::int64_t y = lanes.next[1][lane];
    std::int64_t z = lanes.next[2][lane];
    std::int64_t at_x = lanes.at[0][lane];
    std::int64_t at_y = lanes.at[1][lane];
    std::int64_t at_z = lanes.at[2][lane];
    for (std::int64_t step = 0; step < steps; ++step) {
      mark(plane, lanes.base[lane] + at_x + at_y + at_z);
      const std::int64_t goes_x = -static_cast<std::int64_t>((x <= y) & (x <= z));
      const std::int64_t goes_y = ~goes_x & -static_cast<std::int64_t>(y <= z);
      const std::int64_t goes_z = ~goes_x & ~goes_y;
      x += lanes.delta[0][lane] & goes_x;
      y += lanes.delta[1][lane] & goes_y;
      z += lanes.delta[2][lane] & goes_z;
      at_x = (at_x + (lanes.step[0][lane] & goes_x)) & mask_x;
      at_y = (at_y + (lanes.step[1][lane] & goes_y)) & mask_y;
      at_z = (at_z + (lanes.step[2][lane] & goes_z)) & mask_z;
    }
    lanes.next[0][lane] = x;
    lanes.next[1][lane] = y;
    lanes.next[2][lane] = z;
    lanes.at[0][lane] = at_x;
    lanes.at[1][lane] = at_y;
    lanes.at[2][lane] = at_z;
  }
}

#if defined(__x86_64__)

VANTAGE_TARGET_AVX512 inline void walk_avx512(RayLanes& lanes, std::int64_t steps, std::uint64_t* plane) {
  __m512i x = _mm512_load_si512(lanes.next[0].data());
  __m512i y = _mm512_load_si512(lanes.next[1].data());
  __m512i z = _mm512_load_si512(lanes.next[2].data());
  __m512i at_x = _mm512_load_si512(lanes.at[0].data());
  __m512i at_y = _mm512_load_si512(lanes.at[1].data());
  __m512i at_z = _mm512_load_si512(lanes.at[2].data());
  const __m512i delta_x = _mm512_load_si512(lanes.delta[0].data());
  const __m512i delta_y = _mm512_load_si512(lanes.delta[1].data());
  const __m512i delta_z = _mm512_load_si512(lanes.delta[2].data());
  const __m512i step_x = _mm512_load_si512(lanes.step[0].data());
  const __m512i step_y = _mm512_load_si512(lanes.step[1].data());
  const __m512i step_z = _mm512_load_si512(lanes.step[2].data());
  const __m512i base = _mm512_load_si512(lanes.base.data());
  const __m512i mask_x = _mm512_set1_epi64(lanes.mask[0]);
  const __m512i mask_y = _mm512_set1_epi64(lanes.mask[1]);
  const __m512i mask_z = _mm512_set1_epi64(lanes.mask[2]);
  alignas(64) RayLanes::PerLane<std::int64_t> positions;
  for (; steps > 0; --steps) {
    _mm512_store_si512(positions.data(), _mm512_or_si512(_mm512_or_si512(base, at_x), _mm512_or_si512(at_y, at_z)));
    const __mmask8 y_first = _mm512_cmple_epi64_mask(y, z);
    const __mmask8 goes_x = _mm512_mask_cmple_epi64_mask(_mm512_cmple_epi64_mask(x, y), x, z);
    const auto goes_y = static_cast<__mmask8>(~goes_x & y_first);
    const auto goes_z = static_cast<__mmask8>(~goes_x & ~y_first);
    x = _mm512_mask_add_epi64(x, goes_x, x, delta_x);
    y = _mm512_mask_add_epi64(y, goes_y, y, delta_y);
    z = _mm512_mask_add_epi64(z, goes_z, z, delta_z);
    at_x = _mm512_and_si512(_mm512_mask_add_epi64(at_x, goes_x, at_x, step_x), mask_x);
    at_y = _mm512_and_si512(_mm512_mask_add_epi64(at_y, goes_y, at_y, step_y), mask_y);
    at_z = _mm512_and_si512(_mm512_mask_add_epi64(at_z, goes_z, at_z, step_z), mask_z);
    for (const std::int64_t position : positions) {
      mark(plane, position);
    }
  }
  _mm512_store_si512(lanes.next[0].data(), x);
  _mm512_store_si512(lanes.next[1].data(), y);
  _mm512_store_si512(lanes.next[2].data(), z);
  _mm512_store_si512(lanes.at[0].data(), at_x);
  _mm512_store_si512(lanes.at[1].data(), at_y);
  _mm512_store_si512(lanes.at[2].data(), at_z);
}

VANTAGE_TARGET_AVX2 inline __m256i load_four(const std::int64_t* four) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(four));
}
VANTAGE_TARGET_AVX2 inline void store_four(std::int64_t* four, __m256i vector) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(four), vector);
}

// Walks four lanes, the number that fits into a register.
VANTAGE_TARGET_AVX2 inline void walk_avx2(RayLanes& lanes, std::int64_t steps, std::uint64_t* plane,
                                          std::size_t first) {
  __m256i x = load_four(&lanes.next[0][first]);
  __m256i y = load_four(&lanes.next[1][first]);
  __m256i z = load_four(&lanes.next[2][first]);
  __m256i at_x = load_four(&lanes.at[0][first]);
  __m256i at_y = load_four(&lanes.at[1][first]);
  __m256i at_z = load_four(&lanes.at[2][first]);
  alignas(32) std::array<std::int64_t, 4> positions;
  for (std::int64_t step = 0; step < steps; ++step) {
    const __m256i position =
        _mm256_or_si256(_mm256_or_si256(load_four(&lanes.base[first]), at_x), _mm256_or_si256(at_y, at_z));
    store_four(positions.data(), position);
    const __m256i z_first = _mm256_cmpgt_epi64(y, z);
    const __m256i stays_x = _mm256_or_si256(_mm256_cmpgt_epi64(x, y), _mm256_cmpgt_epi64(x, z));
    const __m256i goes_y = _mm256_andnot_si256(z_first, stays_x);
    const __m256i goes_z = _mm256_and_si256(z_first, stays_x);
    x = _mm256_add_epi64(x, _mm256_andnot_si256(stays_x, load_four(&lanes.delta[0][first])));
    y = _mm256_add_epi64(y, _mm256_and_si256(goes_y, load_four(&lanes.delta[1][first])));
    z = _mm256_add_epi64(z, _mm256_and_si256(goes_z, load_four(&lanes.delta[2][first])));
    at_x = _mm256_add_epi64(at_x, _mm256_andnot_si256(stays_x, load_four(&lanes.step[0][first])));
    at_y = _mm256_add_epi64(at_y, _mm256_and_si256(goes_y, load_four(&lanes.step[1][first])));
    at_z = _mm256_add_epi64(at_z, _mm256_and_si256(goes_z, load_four(&lanes.step[2][first])));
    at_x = _mm256_and_si256(at_x, _mm256_set1_epi64x(lanes.mask[0]));
    at_y = _mm256_and_si256(at_y, _mm256_set1_epi64x(lanes.mask[1]));
    at_z = _mm256_and_si256(at_z, _mm256_set1_epi64x(lanes.mask[2]));
    for (const std::int64_t one : positions) {
      mark(plane, one);
    }
  }
  store_four(&lanes.next[0][first], x);
  store_four(&lanes.next[1][first], y);
  store_four(&lanes.next[2][first], z);
  store_four(&lanes.at[0][first], at_x);
  store_four(&lanes.at[1][first], at_y);
  store_four(&lanes.at[2][first], at_z);
}
#endif

VANTAGE_INLINE void RayLanes::walk(std::int64_t steps, std::uint64_t* plane, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    walk_avx512(*this, steps, plane);
    return;
  }
  if (set == InstructionSet::Avx2) {
    walk_avx2(*this, steps, plane, 0);
    walk_avx2(*this, steps, plane, 4);
    return;
  }
#endif
  (void)set;
  walk_baseline(*this, steps, plane);
}

}  // namespace vantage::detail
