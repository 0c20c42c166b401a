// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <vantage/raytrace/impl/beam_passages.hpp>
#include <vantage/raytrace/impl/slice_windows.hpp>

namespace vantage {
namespace detail {

inline bool any_in(const WindowPatch& patch, const WindowRows& rows) {
  std::uint32_t any = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    any |= rows[row] & patch.in_row(row);
  }
  return any != 0;
}

// A bit for each slice that holds any of these cells inside the patch.
inline std::uint32_t slices_with(const WindowPatch& patch, const WindowCells& cells) {
  std::uint32_t slices = 0;
  for (std::size_t slice = 0; slice < cells.size(); ++slice) {
    slices |= std::uint32_t{any_in(patch, cells[slice])} << slice;
  }
  return slices;
}

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

}  // namespace detail

VANTAGE_INLINE void BeamPassages::keep(const SliceBeam& beam) {
  const Passage& passage = passages_[size_];
  enters_[size_] = beam.entered_at(passage.windows.first);
  leaves_[size_] = beam.entered_at(passage.windows.first + static_cast<std::int64_t>(passage.windows.count));
  from_u_[size_] = beam.within[0] + (beam.first[0] - passage.windows.place.first_u);
  from_v_[size_] = beam.within[1] + (beam.first[1] - passage.windows.place.first_v);
  ++size_;
}

VANTAGE_INLINE std::uint64_t BeamPassages::to_pass(const SliceBeam& beam, InstructionSet set) const {
  // bit mask of the columns and rows of the windows that the beam may pass
  alignas(64) PerPassage<std::uint32_t> columns;
  alignas(64) PerPassage<std::uint32_t> rows;
  compiled_for(set, [this, of_columns = columns.data(), of_rows = rows.data(), least_u = beam.least[0],
                     most_u = beam.most[0], least_v = beam.least[1], most_v = beam.most[1]] {
    VANTAGE_INDEPENDENT
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kMost; ++i) {
      const double enters = enters_[i];
      const double leaves = leaves_[i];
      const double left = least_u * (least_u < 0.0 ? leaves : enters);
      const double right = most_u * (most_u > 0.0 ? leaves : enters);
      const double top = least_v * (least_v < 0.0 ? leaves : enters);
      const double bottom = most_v * (most_v > 0.0 ? leaves : enters);
      of_columns[i] = bits_between(column_at(from_u_[i] + left - SliceBeam::kRounding),
                                   column_at(from_u_[i] + right + SliceBeam::kRounding));
      of_rows[i] = bits_between(row_at(from_v_[i] + top - SliceBeam::kRounding),
                                row_at(from_v_[i] + bottom + SliceBeam::kRounding));
    }
  });
  const auto slices_of = [set](const WindowPatch& patch, const WindowCells& cells) {
#if defined(__x86_64__)
    if (set == InstructionSet::Avx512) {
      return detail::slices_with_avx512(patch, cells);
    }
#endif
    (void)set;
    return detail::slices_with(patch, cells);
  };
  std::uint64_t blocking = 0;
  std::uint64_t wanted = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const WindowPatch patch{columns[i], rows[i]};
    const std::uint32_t there = (1U << passages_[i].windows.count) - 1;
    blocking |= std::uint64_t{slices_of(patch, passages_[i].windows.rows) & there} << 4 * i;
    wanted |= std::uint64_t{slices_of(patch, passages_[i].wanted)} << 4 * i;
  }
  return wanted == 0 ? 0 : blocking & ~std::uint64_t{0} >> std::countl_zero(wanted);
}

}  // namespace vantage
