// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <limits>
#include <raytrace/slice_lanes.hpp>
#include <vantage/geometry/voxel_ray.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage {
namespace {

constexpr double kLarge = std::numeric_limits<double>::max();

// Of faces crossed at the same time, that across the lower axis comes first: those across a lateral axis above the
// major one only up to the time before.
std::int64_t tie(std::size_t lateral, std::size_t major) { return lateral > major ? 1 : 0; }

bool stops(const SliceWindows& windows, std::size_t slice, std::int64_t within) {
  return (windows.rows[slice][static_cast<std::size_t>(within >> 5)] >> (within & 31) & 1U) != 0;
}

// One ray after the other: the definition of the vectorised walks below, and what runs where there is neither.
void walk_baseline(SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active, SliceHits& hits) {
  const std::int64_t tie_u = tie(lanes.u, lanes.major);
  const std::int64_t tie_v = tie(lanes.v, lanes.major);
  for (; active != 0; active &= active - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(active));
    std::int64_t leaves = lanes.next[lanes.major][i];
    std::int64_t next_u = lanes.next[lanes.u][i];
    std::int64_t next_v = lanes.next[lanes.v][i];
    std::int64_t within = lanes.at[i] - windows.origin;
    for (std::size_t slice = 0; slice < windows.count; ++slice) {
      bool stopped = stops(windows, slice, within);
      const bool crosses_u = next_u <= std::min(leaves - tie_u, FaceCrossings::kEnd);
      const bool crosses_v = next_v <= std::min(leaves - tie_v, FaceCrossings::kEnd);
      const bool u_first = crosses_u && (!crosses_v || next_u <= next_v);
      if (!stopped && (crosses_u || crosses_v)) {
        within += u_first ? lanes.step_u[i] : lanes.step_v[i];
        stopped = stops(windows, slice, within);
        if (!stopped && crosses_u && crosses_v) {
          within += u_first ? lanes.step_v[i] : lanes.step_u[i];
          stopped = stops(windows, slice, within);
        }
      }
      if (stopped || leaves > FaceCrossings::kEnd) {
        (stopped ? hits.stopped : hits.ended) |= std::uint64_t{1} << i;
        hits.slice[i] = static_cast<std::int64_t>(slice);
        hits.within[i] = within;
        break;
      }
      leaves += lanes.delta[lanes.major][i];
      next_u += crosses_u ? lanes.delta[lanes.u][i] : 0;
      next_v += crosses_v ? lanes.delta[lanes.v][i] : 0;
    }
    lanes.next[lanes.major][i] = leaves;
    lanes.next[lanes.u][i] = next_u;
    lanes.next[lanes.v][i] = next_v;
    lanes.at[i] = within + windows.origin;
  }
}

#if defined(__x86_64__)

// All lanes. (Where all are meant, the forms without a mask make g++ 12 warn of values that are never used.)
constexpr __mmask8 kAll = 0xFF;

// A window is a register of eight words, two rows in each: a position is a word and a bit of it.
VANTAGE_TARGET_AVX512 inline __mmask8 stops(__m512i window, __m512i within) {
  const __m512i word = _mm512_maskz_permutexvar_epi64(kAll, _mm512_maskz_srli_epi64(kAll, within, 6), window);
  return _mm512_test_epi64_mask(_mm512_maskz_rorv_epi64(kAll, word, within), _mm512_set1_epi64(1));
}

VANTAGE_TARGET_AVX512 void walk_avx512(SliceLanes& lanes, const SliceWindows& windows, std::size_t first,
                                       __mmask8 active, SliceHits& hits) {
  const __m512i end = _mm512_set1_epi64(FaceCrossings::kEnd);
  const __m512i tie_u = _mm512_set1_epi64(tie(lanes.u, lanes.major));
  const __m512i tie_v = _mm512_set1_epi64(tie(lanes.v, lanes.major));
  const __m512i delta_m = _mm512_load_si512(&lanes.delta[lanes.major][first]);
  const __m512i delta_u = _mm512_load_si512(&lanes.delta[lanes.u][first]);
  const __m512i delta_v = _mm512_load_si512(&lanes.delta[lanes.v][first]);
  const __m512i step_u = _mm512_load_si512(&lanes.step_u[first]);
  const __m512i step_v = _mm512_load_si512(&lanes.step_v[first]);
  __m512i leaves = _mm512_load_si512(&lanes.next[lanes.major][first]);
  __m512i next_u = _mm512_load_si512(&lanes.next[lanes.u][first]);
  __m512i next_v = _mm512_load_si512(&lanes.next[lanes.v][first]);
  __m512i at = _mm512_sub_epi64(_mm512_load_si512(&lanes.at[first]), _mm512_set1_epi64(windows.origin));
  for (std::size_t slice = 0; slice < windows.count && active != 0; ++slice) {
    const __m512i window = _mm512_load_si512(windows.rows[slice].data());
    const __mmask8 u =
        _mm512_cmple_epi64_mask(next_u, _mm512_maskz_min_epi64(kAll, _mm512_sub_epi64(leaves, tie_u), end));
    const __mmask8 v =
        _mm512_cmple_epi64_mask(next_v, _mm512_maskz_min_epi64(kAll, _mm512_sub_epi64(leaves, tie_v), end));
    const auto u_first = static_cast<__mmask8>(u & (~v | _mm512_cmple_epi64_mask(next_u, next_v)));
    const auto v_first = static_cast<__mmask8>(v & ~u_first);
    const __m512i once = _mm512_mask_add_epi64(_mm512_mask_add_epi64(at, u_first, at, step_u), v_first, at, step_v);
    const __m512i twice =
        _mm512_mask_add_epi64(_mm512_mask_add_epi64(once, static_cast<__mmask8>(u & ~u_first), once, step_u),
                              static_cast<__mmask8>(v & ~v_first), once, step_v);
    const auto at_once = static_cast<__mmask8>(stops(window, at) & active);
    const auto after_one = static_cast<__mmask8>(stops(window, once) & active);
    const auto after_two = static_cast<__mmask8>(stops(window, twice) & active);
    const auto stopped = static_cast<__mmask8>(at_once | after_one | after_two);
    const auto ended = static_cast<__mmask8>(_mm512_cmpgt_epi64_mask(leaves, end) & active & ~stopped);
    if (stopped != 0) {
      const __m512i where = _mm512_mask_blend_epi64(at_once, _mm512_mask_blend_epi64(after_one, twice, once), at);
      _mm512_mask_store_epi64(&hits.slice[first], stopped, _mm512_set1_epi64(static_cast<std::int64_t>(slice)));
      _mm512_mask_store_epi64(&hits.within[first], stopped, where);
    }
    hits.stopped |= std::uint64_t{stopped} << first;
    hits.ended |= std::uint64_t{ended} << first;
    active = static_cast<__mmask8>(active & ~(stopped | ended));
    at = twice;
    leaves = _mm512_add_epi64(leaves, delta_m);
    next_u = _mm512_mask_add_epi64(next_u, u, next_u, delta_u);
    next_v = _mm512_mask_add_epi64(next_v, v, next_v, delta_v);
  }
  _mm512_store_si512(&lanes.next[lanes.major][first], leaves);
  _mm512_store_si512(&lanes.next[lanes.u][first], next_u);
  _mm512_store_si512(&lanes.next[lanes.v][first], next_v);
  _mm512_store_si512(&lanes.at[first], _mm512_add_epi64(at, _mm512_set1_epi64(windows.origin)));
}

VANTAGE_TARGET_AVX512 std::uint64_t equal_avx512(const RayBlock::PerRay<std::int64_t>& values, std::int64_t value) {
  std::uint64_t equal = 0;
  for (std::size_t first = 0; first < values.size(); first += 8) {
    const __m512i eight = _mm512_loadu_si512(&values[first]);
    equal |= std::uint64_t{_mm512_cmpeq_epi64_mask(eight, _mm512_set1_epi64(value))} << first;
  }
  return equal;
}

VANTAGE_TARGET_AVX512 std::pair<double, double> range_avx512(const RayBlock::PerRay<double>& values,
                                                             std::uint64_t active) {
  __m512d least = _mm512_set1_pd(kLarge);
  __m512d most = _mm512_set1_pd(-kLarge);
  for (std::size_t first = 0; first < values.size(); first += 8) {
    const __m512d eight = _mm512_loadu_pd(&values[first]);
    const auto some = static_cast<__mmask8>(active >> first);
    least = _mm512_mask_min_pd(least, some, least, eight);
    most = _mm512_mask_max_pd(most, some, most, eight);
  }
  alignas(64) std::array<double, 8> lows;
  alignas(64) std::array<double, 8> highs;
  _mm512_store_pd(lows.data(), least);
  _mm512_store_pd(highs.data(), most);
  return {*std::min_element(lows.begin(), lows.end()), *std::max_element(highs.begin(), highs.end())};
}

// Four rays at a time; masks are whole lanes.
VANTAGE_TARGET_AVX2 inline __m256i load(const std::int64_t* four) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(four));
}
VANTAGE_TARGET_AVX2 inline void store(std::int64_t* four, __m256i vector) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(four), vector);
}
VANTAGE_TARGET_AVX2 inline __m256i min(__m256i a, __m256i b) {
  return _mm256_blendv_epi8(a, b, _mm256_cmpgt_epi64(a, b));
}

// A window is two registers of eight rows.
VANTAGE_TARGET_AVX2 inline __m256i stops(const std::uint32_t* rows, __m256i within) {
  const auto* const halves = reinterpret_cast<const __m256i*>(rows);
  const __m256i row = _mm256_srli_epi64(within, 5);
  const __m256i low = _mm256_permutevar8x32_epi32(_mm256_load_si256(halves), row);
  const __m256i high = _mm256_permutevar8x32_epi32(_mm256_load_si256(halves + 1), row);
  const __m256i is_high = _mm256_cmpgt_epi64(row, _mm256_set1_epi64x(7));
  const __m256i bit = _mm256_and_si256(within, _mm256_set1_epi64x(31));
  const __m256i found = _mm256_srlv_epi64(_mm256_blendv_epi8(low, high, is_high), bit);
  return _mm256_cmpeq_epi64(_mm256_and_si256(found, _mm256_set1_epi64x(1)), _mm256_set1_epi64x(1));
}

VANTAGE_TARGET_AVX2 inline std::uint64_t bits(__m256i lanes) {
  return static_cast<std::uint64_t>(_mm256_movemask_pd(_mm256_castsi256_pd(lanes)));
}

VANTAGE_TARGET_AVX2 void walk_avx2(SliceLanes& lanes, const SliceWindows& windows, std::size_t first,
                                   std::uint64_t active, SliceHits& hits) {
  const __m256i end = _mm256_set1_epi64x(FaceCrossings::kEnd);
  const __m256i tie_u = _mm256_set1_epi64x(tie(lanes.u, lanes.major));
  const __m256i tie_v = _mm256_set1_epi64x(tie(lanes.v, lanes.major));
  const __m256i step_u = load(&lanes.step_u[first]);
  const __m256i step_v = load(&lanes.step_v[first]);
  __m256i leaves = load(&lanes.next[lanes.major][first]);
  __m256i next_u = load(&lanes.next[lanes.u][first]);
  __m256i next_v = load(&lanes.next[lanes.v][first]);
  __m256i at = _mm256_sub_epi64(load(&lanes.at[first]), _mm256_set1_epi64x(windows.origin));
  for (std::size_t slice = 0; slice < windows.count && active != 0; ++slice) {
    const std::uint32_t* const rows = windows.rows[slice].data();
    const __m256i not_u = _mm256_cmpgt_epi64(next_u, min(_mm256_sub_epi64(leaves, tie_u), end));
    const __m256i not_v = _mm256_cmpgt_epi64(next_v, min(_mm256_sub_epi64(leaves, tie_v), end));
    const __m256i u_later = _mm256_andnot_si256(not_v, _mm256_cmpgt_epi64(next_u, next_v));
    const __m256i not_u_first = _mm256_or_si256(not_u, u_later);
    const __m256i u_first = _mm256_andnot_si256(not_u_first, step_u);
    const __m256i v_first = _mm256_and_si256(not_u_first, _mm256_andnot_si256(not_v, step_v));
    const __m256i once = _mm256_add_epi64(at, _mm256_add_epi64(u_first, v_first));
    const __m256i u_and_v = _mm256_add_epi64(_mm256_andnot_si256(not_u, step_u), _mm256_andnot_si256(not_v, step_v));
    const __m256i twice = _mm256_add_epi64(at, u_and_v);
    const __m256i at_once = stops(rows, at);
    const __m256i after_one = stops(rows, once);
    const std::uint64_t stopped = (bits(at_once) | bits(after_one) | bits(stops(rows, twice))) & active;
    const std::uint64_t ended = bits(_mm256_cmpgt_epi64(leaves, end)) & active & ~stopped;
    if (stopped != 0) {
      alignas(32) std::array<std::int64_t, 4> where;
      store(where.data(), _mm256_blendv_epi8(_mm256_blendv_epi8(twice, once, after_one), at, at_once));
      for (std::uint64_t left = stopped; left != 0; left &= left - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(left));
        hits.slice[first + lane] = static_cast<std::int64_t>(slice);
        hits.within[first + lane] = where[lane];
      }
    }
    hits.stopped |= stopped << first;
    hits.ended |= ended << first;
    active &= ~(stopped | ended);
    at = twice;
    leaves = _mm256_add_epi64(leaves, load(&lanes.delta[lanes.major][first]));
    next_u = _mm256_add_epi64(next_u, _mm256_andnot_si256(not_u, load(&lanes.delta[lanes.u][first])));
    next_v = _mm256_add_epi64(next_v, _mm256_andnot_si256(not_v, load(&lanes.delta[lanes.v][first])));
  }
  store(&lanes.next[lanes.major][first], leaves);
  store(&lanes.next[lanes.u][first], next_u);
  store(&lanes.next[lanes.v][first], next_v);
  store(&lanes.at[first], _mm256_add_epi64(at, _mm256_set1_epi64x(windows.origin)));
}

#endif

// Faces crossed up to `time`, without a branch: a quotient in floating point is at most one off.
inline std::int64_t crossed_by(std::int64_t time, std::int64_t next, std::int64_t delta) {
  const std::int64_t since = time - next;
  const std::int64_t step = delta + static_cast<std::int64_t>(delta == 0);
  const auto faces = static_cast<std::int64_t>(static_cast<double>(since) / static_cast<double>(step));
  const std::int64_t rest = since - faces * step;
  const std::int64_t exact = faces + static_cast<std::int64_t>(rest >= step) - static_cast<std::int64_t>(rest < 0);
  return static_cast<std::int64_t>(since >= 0) * static_cast<std::int64_t>(delta > 0) * (exact + 1);
}

}  // namespace

std::uint64_t equal_to(const RayBlock::PerRay<std::int64_t>& values, std::int64_t value, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return equal_avx512(values, value);
  }
#endif
  (void)set;
  std::uint64_t equal = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    equal |= static_cast<std::uint64_t>(values[i] == value) << i;
  }
  return equal;
}

std::pair<double, double> range_of(const RayBlock::PerRay<double>& values, std::uint64_t active, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    return range_avx512(values, active);
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

void walk_slices(SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active, SliceHits& hits,
                 InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    for (std::size_t first = 0; first < RayBlock::kRays; first += 8) {
      if (const auto some = static_cast<__mmask8>(active >> first); some != 0) {
        walk_avx512(lanes, windows, first, some, hits);
      }
    }
    return;
  }
  if (set == InstructionSet::Avx2) {
    for (std::size_t first = 0; first < RayBlock::kRays; first += 4) {
      if (const std::uint64_t some = active >> first & 15U; some != 0) {
        walk_avx2(lanes, windows, first, some, hits);
      }
    }
    return;
  }
#endif
  (void)set;
  walk_baseline(lanes, windows, active, hits);
}

std::uint64_t skip_slices(SliceLanes& lanes, std::int64_t slices, std::uint64_t active, InstructionSet set) {
  const std::int64_t tie_u = tie(lanes.u, lanes.major);
  const std::int64_t tie_v = tie(lanes.v, lanes.major);
  std::int64_t* const next_m = lanes.next[lanes.major].data();
  std::int64_t* const next_u = lanes.next[lanes.u].data();
  std::int64_t* const next_v = lanes.next[lanes.v].data();
  const std::int64_t* const delta_m = lanes.delta[lanes.major].data();
  const std::int64_t* const delta_u = lanes.delta[lanes.u].data();
  const std::int64_t* const delta_v = lanes.delta[lanes.v].data();
  const std::int64_t* const step_u = lanes.step_u.data();
  const std::int64_t* const step_v = lanes.step_v.data();
  std::int64_t* const at = lanes.at.data();
  RayBlock::PerRay<std::int64_t> ended;
  compiled_for(set, [=, &ended] {
    std::int64_t* const ends = ended.data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      // Where rays are that are not active is undefined: they count as nothing.
      const std::int64_t mask = -static_cast<std::int64_t>(active >> i & 1U);
      const std::int64_t forward = slices & mask;
      const std::int64_t enters = (next_m[i] & mask) + (forward - 1) * (delta_m[i] & mask);
      const std::int64_t faces_u = crossed_by(enters - tie_u, next_u[i] & mask, delta_u[i] & mask);
      const std::int64_t faces_v = crossed_by(enters - tie_v, next_v[i] & mask, delta_v[i] & mask);
      ends[i] = static_cast<std::int64_t>(enters > FaceCrossings::kEnd);
      next_m[i] += forward * delta_m[i];
      next_u[i] += faces_u * delta_u[i];
      next_v[i] += faces_v * delta_v[i];
      at[i] += faces_u * step_u[i] + faces_v * step_v[i];
    }
  });
  return equal_to(ended, 1, set) & active;
}

}  // namespace vantage
