// SPDX-License-Identifier: MIT
#include <map/ray_lanes.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage {
namespace {

void mark(std::uint64_t* plane, std::int64_t position) { plane[position >> 6] |= std::uint64_t{1} << (position & 63); }

// One lane after the other: the definition of the vectorised walks below, and what runs where there is neither.
void walk_baseline(RayLanes& lanes, std::int64_t steps, std::uint64_t* plane) {
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

[[gnu::target("avx512f")]] void walk_avx512(RayLanes& lanes, std::int64_t steps, std::uint64_t* plane) {
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

bool has_avx512() {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx512f") != 0;
}
#endif

using Walk = void (*)(RayLanes&, std::int64_t, std::uint64_t*);

Walk best_walk() {
#if defined(__x86_64__)
  if (has_avx512()) {
    return walk_avx512;
  }
#endif
  return walk_baseline;
}

}  // namespace

void RayLanes::walk(std::int64_t steps, std::uint64_t* plane) {
  static const Walk best = best_walk();
  best(*this, steps, plane);
}

}  // namespace vantage
