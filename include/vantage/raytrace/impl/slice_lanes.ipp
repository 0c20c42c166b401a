// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <vantage/raytrace/impl/slice_lanes.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage::detail {

inline constexpr int kBits = static_cast<int>(SliceLanes::kBits);
// A position is near an edge between cells if all these bits of the position plus kDoubt are zero.
inline constexpr std::int32_t kAfterPoint = (SliceLanes::kCell - 1) & ~(2 * SliceLanes::kDoubt - 1);
// Largest error of the product difference that tells which of two faces is crossed first. Each product has the error
// of a position and the rounding of single precision, times a step of at most one cell.
inline constexpr auto kDoubtOfOrder = static_cast<float>(std::int64_t{4} * SliceLanes::kDoubt * SliceLanes::kCell);

// A position in a slice: its cell, and whether it is near an edge.
struct Place {
  Place(std::int32_t u, std::int32_t v)
      : column(u >> kBits),
        row(v >> kBits),
        near_edge(((u + SliceLanes::kDoubt) & kAfterPoint) == 0 || ((v + SliceLanes::kDoubt) & kAfterPoint) == 0) {}
  std::int32_t column;
  std::int32_t row;
  bool near_edge;
};

enum class First : std::uint8_t { U, V, Unsure };

// Which face is crossed first on the way to another column and another row.
inline First first_crossed(const Place& from, const Place& to, std::int32_t u, std::int32_t v, std::int32_t step_u,
                           std::int32_t step_v) {
  const std::int32_t until_u = std::abs((std::max(from.column, to.column) << kBits) - u);
  const std::int32_t until_v = std::abs((std::max(from.row, to.row) << kBits) - v);
  // The time to a face is a distance divided by a step. Multiplied by both steps, the times compare without division.
  const float v_later = static_cast<float>(until_v) * static_cast<float>(std::abs(step_u)) -
                        static_cast<float>(until_u) * static_cast<float>(std::abs(step_v));
  return v_later >= kDoubtOfOrder ? First::U : v_later <= -kDoubtOfOrder ? First::V : First::Unsure;
}

// Walks one ray after the other. This is the reference for the vectorised versions below, and the fallback without
// them.
inline void walk_baseline(const SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active,
                          SliceHits& hits) {
  for (; active != 0; active &= active - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(active));
    const std::uint64_t ray = std::uint64_t{1} << i;
    std::int32_t u = lanes.u[i];
    std::int32_t v = lanes.v[i];
    Place from(u, v);
    if (from.near_edge) {
      hits.doubtful |= ray;
      continue;
    }
    for (std::size_t slice = 0; slice < windows.count; ++slice) {
      const auto stop = [&](std::int32_t column, std::int32_t row) {
        if ((windows.rows[slice][static_cast<std::size_t>(row)] >> column & 1U) == 0) {
          return false;
        }
        hits.stopped |= ray;
        hits.where[i] =
            column + SliceWindows::kWidth * (row + SliceWindows::kHeight * static_cast<std::int32_t>(slice));
        return true;
      };
      const Place to(u + lanes.step_u[i], v + lanes.step_v[i]);
      if (stop(from.column, from.row)) {
        break;
      }
      bool doubtful = to.near_edge;
      if (!doubtful && from.column != to.column && from.row != to.row) {
        const First first = first_crossed(from, to, u, v, lanes.step_u[i], lanes.step_v[i]);
        if (first != First::Unsure) {
          if (first == First::U ? stop(to.column, from.row) : stop(from.column, to.row)) {
            break;
          }
        } else {
          // The order matters only if one of the two cells stops the ray.
          const std::uint32_t either = windows.rows[slice][static_cast<std::size_t>(from.row)] >> to.column |
                                       windows.rows[slice][static_cast<std::size_t>(to.row)] >> from.column;
          doubtful = (either & 1U) != 0;
        }
      }
      if (doubtful) {
        hits.doubtful |= ray;
        break;
      }
      if (stop(to.column, to.row)) {
        break;
      }
      from = to;
      u += lanes.step_u[i];
      v += lanes.step_v[i];
    }
  }
}

#if defined(__x86_64__)

// All lanes. (With the intrinsics without a mask, g++ 12 warns about unused values.)
inline constexpr __mmask16 kAll = 0xFFFF;

VANTAGE_TARGET_AVX512 inline __m512i cell_of(__m512i place) { return _mm512_maskz_srai_epi32(kAll, place, kBits); }

VANTAGE_TARGET_AVX512 inline __mmask16 near_edge(__m512i u, __m512i v) {
  const __m512i doubt = _mm512_set1_epi32(SliceLanes::kDoubt);
  const __m512i after_point = _mm512_set1_epi32(kAfterPoint);
  return static_cast<__mmask16>(_mm512_testn_epi32_mask(_mm512_add_epi32(u, doubt), after_point) |
                                _mm512_testn_epi32_mask(_mm512_add_epi32(v, doubt), after_point));
}

// Whether the bits of these columns are set in these rows. (It rotates instead of shifting, because the column of an
// inactive lane may have any value.)
VANTAGE_TARGET_AVX512 inline __mmask16 is_set(__m512i rows, __m512i columns) {
  return _mm512_test_epi32_mask(_mm512_maskz_rorv_epi32(kAll, rows, columns), _mm512_set1_epi32(1));
}

// Distance from a position to the face between its cell and the other cell.
VANTAGE_TARGET_AVX512 inline __m512 until_face(__m512i from, __m512i to, __m512i place) {
  const __m512i face = _mm512_maskz_slli_epi32(kAll, _mm512_maskz_max_epi32(kAll, from, to), kBits);
  return _mm512_maskz_cvtepi32_ps(kAll, _mm512_maskz_abs_epi32(kAll, _mm512_sub_epi32(face, place)));
}

// For rays that change both column and row: the lanes that certainly cross the face across u first, or across v
// first.
struct Order16 {
  __mmask16 u_first;
  __mmask16 v_first;
};
VANTAGE_TARGET_AVX512 inline Order16 order_of(__m512 until_u, __m512 until_v, __m512i step_u, __m512i step_v) {
  const __m512 far_u = _mm512_maskz_cvtepi32_ps(kAll, _mm512_maskz_abs_epi32(kAll, step_u));
  const __m512 far_v = _mm512_maskz_cvtepi32_ps(kAll, _mm512_maskz_abs_epi32(kAll, step_v));
  const __m512 v_later = _mm512_sub_ps(_mm512_mul_ps(until_v, far_u), _mm512_mul_ps(until_u, far_v));
  return {_mm512_cmp_ps_mask(v_later, _mm512_set1_ps(kDoubtOfOrder), _CMP_GE_OQ),
          _mm512_cmp_ps_mask(v_later, _mm512_set1_ps(-kDoubtOfOrder), _CMP_LE_OQ)};
}

// Replaces `where` of the stopped lanes by this cell, as SliceHits stores it.
VANTAGE_TARGET_AVX512 inline __m512i stopped_at(__m512i where, __mmask16 stopped, __m512i row, __m512i column,
                                                std::size_t slice) {
  const __m512i first = _mm512_set1_epi32(static_cast<std::int32_t>(slice) * 512);
  const __m512i cell =
      _mm512_maskz_or_epi32(kAll, _mm512_maskz_slli_epi32(kAll, row, 5), _mm512_maskz_or_epi32(kAll, column, first));
  return _mm512_mask_mov_epi32(where, stopped, cell);
}

// Whether any of the four cells in these two columns and two rows is set.
VANTAGE_TARGET_AVX512 inline __mmask16 any_is_set(__m512i row, __m512i other_row, __m512i column, __m512i other) {
  const __m512i in_row = _mm512_maskz_or_epi32(kAll, _mm512_maskz_rorv_epi32(kAll, row, column),
                                               _mm512_maskz_rorv_epi32(kAll, row, other));
  const __m512i in_other = _mm512_maskz_or_epi32(kAll, _mm512_maskz_rorv_epi32(kAll, other_row, column),
                                                 _mm512_maskz_rorv_epi32(kAll, other_row, other));
  return _mm512_test_epi32_mask(_mm512_maskz_or_epi32(kAll, in_row, in_other), _mm512_set1_epi32(1));
}

// As walk_baseline, for 16 rays. The 16 rows of a window fill one register, and a permutation selects the row of each
// ray.
VANTAGE_TARGET_AVX512 inline void walk_avx512(const SliceLanes& lanes, const SliceWindows& windows, std::size_t first,
                                              __mmask16 active, SliceHits& hits) {
  const __m512i step_u = _mm512_load_si512(&lanes.step_u[first]);
  const __m512i step_v = _mm512_load_si512(&lanes.step_v[first]);
  __m512i u = _mm512_load_si512(&lanes.u[first]);
  __m512i v = _mm512_load_si512(&lanes.v[first]);
  __m512i column = cell_of(u);
  __m512i row = cell_of(v);
  __m512i where = _mm512_load_si512(&hits.where[first]);
  auto doubtful = static_cast<__mmask16>(near_edge(u, v) & active);
  __mmask16 stopped = 0;
  active = static_cast<__mmask16>(active & ~doubtful);
  for (std::size_t slice = 0; slice < windows.count && active != 0; ++slice) {
    const __m512i window = _mm512_load_si512(windows.rows[slice].data());
    const __m512i here = _mm512_maskz_permutexvar_epi32(kAll, row, window);
    const __m512i to_u = _mm512_add_epi32(u, step_u);
    const __m512i to_v = _mm512_add_epi32(v, step_v);
    const __m512i to_column = cell_of(to_u);
    const __m512i to_row = cell_of(to_v);
    const __m512i there = _mm512_maskz_permutexvar_epi32(kAll, to_row, window);
    auto unsure = near_edge(to_u, to_v);
    // otherwise nothing happens to any ray
    if (((unsure | any_is_set(here, there, column, to_column)) & active) != 0) {
      const auto at_once = static_cast<__mmask16>(is_set(here, column) & active);
      where = stopped_at(where, at_once, row, column, slice);
      active = static_cast<__mmask16>(active & ~at_once);
      unsure = static_cast<__mmask16>(unsure & active);
      doubtful |= unsure;
      active = static_cast<__mmask16>(active & ~unsure);
      const __mmask16 turns = _mm512_mask_cmpneq_epi32_mask(active, column, to_column);
      const __mmask16 both = _mm512_mask_cmpneq_epi32_mask(turns, row, to_row);
      const auto by_u = static_cast<__mmask16>(is_set(here, to_column) & both);
      const auto by_v = static_cast<__mmask16>(is_set(there, column) & both);
      stopped |= at_once;
      if ((by_u | by_v) != 0) {
        const auto [u_first, v_first] =
            order_of(until_face(column, to_column, u), until_face(row, to_row, v), step_u, step_v);
        const auto stopped_by_u = static_cast<__mmask16>(by_u & u_first);
        const auto stopped_by_v = static_cast<__mmask16>(by_v & v_first);
        const auto not_known = static_cast<__mmask16>((by_u | by_v) & ~(u_first | v_first));
        where = stopped_at(where, stopped_by_u, row, to_column, slice);
        where = stopped_at(where, stopped_by_v, to_row, column, slice);
        stopped |= static_cast<__mmask16>(stopped_by_u | stopped_by_v);
        doubtful |= not_known;
        active = static_cast<__mmask16>(active & ~(stopped_by_u | stopped_by_v | not_known));
      }
      const auto at_last = static_cast<__mmask16>(is_set(there, to_column) & active);
      where = stopped_at(where, at_last, to_row, to_column, slice);
      stopped |= at_last;
      active = static_cast<__mmask16>(active & ~at_last);
    }
    u = to_u;
    v = to_v;
    column = to_column;
    row = to_row;
  }
  _mm512_store_si512(&hits.where[first], where);
  hits.stopped |= std::uint64_t{stopped} << first;
  hits.doubtful |= std::uint64_t{doubtful} << first;
}

// AVX2: eight rays at a time; masks are full lanes.
VANTAGE_TARGET_AVX2 inline __m256i load_eight(const void* eight) {
  return _mm256_load_si256(static_cast<const __m256i*>(eight));
}

VANTAGE_TARGET_AVX2 inline unsigned bits(__m256i lanes) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(lanes)));
}

// Sets all bits of the lanes whose bit is set.
VANTAGE_TARGET_AVX2 inline __m256i lanes_of(unsigned bits) {
  const __m256i each = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  return _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), each), each);
}

VANTAGE_TARGET_AVX2 inline unsigned near_edge(__m256i u, __m256i v) {
  const __m256i doubt = _mm256_set1_epi32(SliceLanes::kDoubt);
  const __m256i after_point = _mm256_set1_epi32(kAfterPoint);
  const __m256i zero = _mm256_setzero_si256();
  const __m256i near_u = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_add_epi32(u, doubt), after_point), zero);
  const __m256i near_v = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_add_epi32(v, doubt), after_point), zero);
  return bits(_mm256_or_si256(near_u, near_v));
}

// The rows of a window, which fills two registers, selected per lane.
VANTAGE_TARGET_AVX2 inline __m256i gathered_rows(const std::uint32_t* window, __m256i row) {
  const __m256i low = _mm256_permutevar8x32_epi32(load_eight(window), row);
  const __m256i high = _mm256_permutevar8x32_epi32(load_eight(window + 8), row);
  // bit 3 of the row, moved to the sign, by which the blend selects
  const __m256i is_high = _mm256_slli_epi32(row, 28);
  return _mm256_castps_si256(
      _mm256_blendv_ps(_mm256_castsi256_ps(low), _mm256_castsi256_ps(high), _mm256_castsi256_ps(is_high)));
}

// Moves the bit of the column to the sign of its lane, which `bits` collects.
VANTAGE_TARGET_AVX2 inline unsigned is_set(__m256i rows, __m256i columns) {
  return bits(_mm256_slli_epi32(_mm256_srlv_epi32(rows, columns), 31));
}

VANTAGE_TARGET_AVX2 inline __m256 until_face(__m256i from, __m256i to, __m256i place) {
  const __m256i face = _mm256_slli_epi32(_mm256_max_epi32(from, to), kBits);
  return _mm256_cvtepi32_ps(_mm256_abs_epi32(_mm256_sub_epi32(face, place)));
}

struct Order8 {
  unsigned u_first;
  unsigned v_first;
};
VANTAGE_TARGET_AVX2 inline Order8 order_of(__m256 until_u, __m256 until_v, __m256i step_u, __m256i step_v) {
  const __m256 far_u = _mm256_cvtepi32_ps(_mm256_abs_epi32(step_u));
  const __m256 far_v = _mm256_cvtepi32_ps(_mm256_abs_epi32(step_v));
  const __m256 v_later = _mm256_sub_ps(_mm256_mul_ps(until_v, far_u), _mm256_mul_ps(until_u, far_v));
  const __m256 certain = _mm256_cmp_ps(v_later, _mm256_set1_ps(kDoubtOfOrder), _CMP_GE_OQ);
  const __m256 against = _mm256_cmp_ps(v_later, _mm256_set1_ps(-kDoubtOfOrder), _CMP_LE_OQ);
  return {bits(_mm256_castps_si256(certain)), bits(_mm256_castps_si256(against))};
}

// As stopped_at, in memory.
VANTAGE_TARGET_AVX2 inline void stop_at(__m256i row, __m256i column, std::size_t slice, unsigned stopped,
                                        std::int32_t* where) {
  const __m256i first = _mm256_set1_epi32(static_cast<std::int32_t>(slice) * 512);
  const __m256i cell = _mm256_or_si256(_mm256_slli_epi32(row, 5), _mm256_or_si256(column, first));
  _mm256_maskstore_epi32(where, lanes_of(stopped), cell);
}

// As walk_avx512, for eight rays.
VANTAGE_TARGET_AVX2 inline void walk_avx2(const SliceLanes& lanes, const SliceWindows& windows, std::size_t first,
                                          unsigned active, SliceHits& hits) {
  const __m256i step_u = load_eight(&lanes.step_u[first]);
  const __m256i step_v = load_eight(&lanes.step_v[first]);
  __m256i u = load_eight(&lanes.u[first]);
  __m256i v = load_eight(&lanes.v[first]);
  __m256i column = _mm256_srai_epi32(u, kBits);
  __m256i row = _mm256_srai_epi32(v, kBits);
  std::int32_t* const where = &hits.where[first];
  unsigned doubtful = near_edge(u, v) & active;
  unsigned stopped = 0;
  active &= ~doubtful;
  for (std::size_t slice = 0; slice < windows.count && active != 0; ++slice) {
    const std::uint32_t* const window = windows.rows[slice].data();
    const __m256i here = gathered_rows(window, row);
    const unsigned at_once = is_set(here, column) & active;
    if (at_once != 0) {
      stop_at(row, column, slice, at_once, where);
      stopped |= at_once;
      active &= ~at_once;
      if (active == 0) {
        break;
      }
    }
    const __m256i to_u = _mm256_add_epi32(u, step_u);
    const __m256i to_v = _mm256_add_epi32(v, step_v);
    const __m256i to_column = _mm256_srai_epi32(to_u, kBits);
    const __m256i to_row = _mm256_srai_epi32(to_v, kBits);
    const unsigned unsure = near_edge(to_u, to_v) & active;
    doubtful |= unsure;
    active &= ~unsure;
    const __m256i there = gathered_rows(window, to_row);
    const __m256i stays = _mm256_or_si256(_mm256_cmpeq_epi32(column, to_column), _mm256_cmpeq_epi32(row, to_row));
    if (const unsigned both = active & ~bits(stays); both != 0) {
      const unsigned by_u = is_set(here, to_column) & both;
      const unsigned by_v = is_set(there, column) & both;
      if ((by_u | by_v) != 0) {
        const auto [u_first, v_first] =
            order_of(until_face(column, to_column, u), until_face(row, to_row, v), step_u, step_v);
        const unsigned not_known = (by_u | by_v) & ~(u_first | v_first);
        stop_at(row, to_column, slice, by_u & u_first, where);
        stop_at(to_row, column, slice, by_v & v_first, where);
        stopped |= (by_u & u_first) | (by_v & v_first);
        doubtful |= not_known;
        active &= ~((by_u & u_first) | (by_v & v_first) | not_known);
      }
    }
    if (const unsigned at_last = is_set(there, to_column) & active; at_last != 0) {
      stop_at(to_row, to_column, slice, at_last, where);
      stopped |= at_last;
      active &= ~at_last;
    }
    u = to_u;
    v = to_v;
    column = to_column;
    row = to_row;
  }
  hits.stopped |= std::uint64_t{stopped} << first;
  hits.doubtful |= std::uint64_t{doubtful} << first;
}

#endif

VANTAGE_INLINE void walk_slices(const SliceLanes& lanes, const SliceWindows& windows, std::uint64_t active,
                                SliceHits& hits, InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx512) {
    for (std::size_t first = 0; first < RayBlock::kRays; first += 16) {
      if (const auto some = static_cast<__mmask16>(active >> first); some != 0) {
        walk_avx512(lanes, windows, first, some, hits);
      }
    }
    return;
  }
  if (set == InstructionSet::Avx2) {
    for (std::size_t first = 0; first < RayBlock::kRays; first += 8) {
      if (const auto some = static_cast<unsigned>(active >> first & 255U); some != 0) {
        walk_avx2(lanes, windows, first, some, hits);
      }
    }
    return;
  }
#endif
  (void)set;
  walk_baseline(lanes, windows, active, hits);
}

}  // namespace vantage::detail
