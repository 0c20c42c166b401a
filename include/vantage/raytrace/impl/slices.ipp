// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vantage/raytrace/impl/slices.hpp>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vantage::detail {

inline constexpr std::int32_t kColumn = 32;  // stride in cells between the starts of neighbouring columns of rows

// Reverses the order of the slices in a word (see in_slices).
inline std::uint64_t reversed(std::uint64_t slices) {
  slices = slices << 32U | slices >> 32U;
  return (slices & 0x0000FFFF0000FFFFU) << 16U | (slices >> 16U & 0x0000FFFF0000FFFFU);
}

// The part of the windows at `place` that these cells fill. They must lie inside (Stop::fits_windows).
inline WindowPatch patch_of(const LateralCells& cells, const SlicePlace& place) {
  return {bits_between(cells.lo[0] - place.first_u, cells.hi[0] - place.first_u),
          bits_between(cells.lo[1] - place.first_v, cells.hi[1] - place.first_v)};
}

inline bool any_in_rows(const std::uint64_t* rows, std::int32_t count, std::uint64_t columns) {
  std::uint64_t any = 0;
  for (std::int32_t row = 0; row < count; ++row) {
    any |= rows[row];
  }
  return (any & columns) != 0;
}

// Copies a window whose first column is bit `shift`. Returns whether any cell of the patch stops a ray.
inline bool cut_window(const std::uint64_t* from, unsigned shift, const WindowPatch& patch, std::uint32_t* to) {
  std::uint32_t any = 0;
  for (std::size_t row = 0; row < SliceWindows::kHeight; ++row) {
    to[row] = static_cast<std::uint32_t>(from[row] >> shift);
    any |= to[row] & patch.in_row(row);
  }
  return any != 0;
}

#if defined(__x86_64__)

VANTAGE_TARGET_AVX512 inline bool any_in_rows_avx512(const std::uint64_t* rows, std::int32_t count,
                                                     std::uint64_t columns) {
  const __m512i of_interest = _mm512_set1_epi64(static_cast<std::int64_t>(columns));
  __mmask8 any = 0;
  for (; count > 0; count -= 8, rows += 8) {
    const auto some = static_cast<__mmask8>(count < 8 ? (1 << count) - 1 : 255);
    any |= _mm512_test_epi64_mask(_mm512_maskz_loadu_epi64(some, rows), of_interest);
  }
  return any != 0;
}

VANTAGE_TARGET_AVX512 inline bool cut_window_avx512(const std::uint64_t* from, unsigned shift,
                                                    const WindowPatch& patch, std::uint32_t* to) {
  constexpr __mmask8 kEight = 255;
  const __m128i by = _mm_cvtsi32_si128(static_cast<std::int32_t>(shift));
  const __m512i low = _mm512_maskz_srl_epi64(kEight, _mm512_loadu_si512(from), by);
  const __m512i high = _mm512_maskz_srl_epi64(kEight, _mm512_loadu_si512(from + 8), by);
  const __m512i cells =
      _mm512_maskz_inserti64x4(kEight, _mm512_castsi256_si512(_mm512_maskz_cvtepi64_epi32(kEight, low)),
                               _mm512_maskz_cvtepi64_epi32(kEight, high), 1);
  _mm512_store_si512(to, cells);
  return _mm512_test_epi32_mask(cells, rows_of(patch)) != 0;
}

#endif

// A beam is widest at its end. It must not be empty.
VANTAGE_INLINE bool ViewSlices::begin(const SliceBeam& beam, std::int64_t last) {
  beam_ = beam;
  last_ = last;
  layers_.clear();
  rows_.clear();
  constexpr std::int32_t kWidest = 128;
  const LateralCells widest = beam.cells_in(last, last + 3);
  if (std::max(widest.extent(0), widest.extent(1)) > kWidest) {
    return false;
  }
  constexpr std::size_t kOftenRead = 16;  // estimate of the number of layers to be read, to reserve memory
  const std::int32_t columns = widest.extent(0) / kColumn + 1;
  const std::int32_t rows = widest.extent(1) + SliceWindows::kHeight;
  rows_.reserve(kOftenRead * kPlanes * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  return true;
}

// Reads all cells that the beam reaches in the layer of a slice, also before that slice. A free layer gives its rows
// back and keeps the number of free layers instead.
VANTAGE_INLINE void ViewSlices::read(std::size_t number, std::int64_t slice) {
  layers_.resize(std::max(layers_.size(), number + 1));
  Layer& layer = layers_[number];
  layer.is_read = true;
  const std::int64_t last = slice + beam_.left_in_layer(slice) - 1;
  const LateralCells cells = beam_.cells_in(std::max<std::int64_t>(last - 3, 0), last);
  layer.first_u = cells.lo[0] & ~3;
  layer.first_v = cells.lo[1] & ~3;
  layer.end_u = (cells.hi[0] | 3) + 1;
  layer.end_v = (cells.hi[1] | 3) + 1;
  const std::int32_t columns = (layer.end_u - layer.first_u + kColumn - 1) / kColumn;
  const std::int32_t rows = layer.end_v - layer.first_v + SliceWindows::kHeight;
  layer.rows = static_cast<std::size_t>(rows);
  layer.first = rows_.size();
  rows_.resize(rows_.size() + kPlanes * static_cast<std::size_t>(columns) * layer.rows);
  const std::int32_t along = beam_.along(slice) >> 2;
  if (!read_rows(layer, along)) {
    rows_.resize(layer.first);
    layer.free = free_from(layer, along);
  }
}

// For a free layer: the number of layers, itself included, in which no cell stops a ray of the beam. (As
// GridSlices::free_layers.)
VANTAGE_INLINE std::int32_t ViewSlices::free_from(const Layer& layer, std::int32_t along) {
  std::int32_t free = BlockingGrid::kFurthest;
  for (std::int32_t v = layer.first_v; v < layer.end_v; v += 4) {
    for (std::int32_t u = layer.first_u; u < layer.end_u; u += 4) {
      free = std::min<std::int32_t>(free, reader_.distance(beam_.axes.at(along, u >> 2, v >> 2)));
    }
  }
  return free;
}

// Returns false if no cell of the layer stops a ray.
VANTAGE_INLINE bool ViewSlices::read_rows(const Layer& layer, std::int32_t along) {
  constexpr std::int32_t kWords = kColumn / 4;
  std::array<std::uint64_t, kWords> words{};
  std::uint64_t any_of_layer = 0;
  for (std::int32_t first_u = layer.first_u; first_u < layer.end_u; first_u += kColumn) {
    const std::int32_t width = std::min(kWords, (layer.end_u - first_u) / 4);
    const auto column = static_cast<std::size_t>((first_u - layer.first_u) / kColumn);
    std::uint64_t* const rows = &rows_[layer.first + kPlanes * column * layer.rows];
    for (std::int32_t v = layer.first_v; v < layer.end_v; v += 4) {
      std::uint64_t any = 0;
      for (std::int32_t u = 0; u < width; ++u) {
        words[static_cast<std::size_t>(u)] = reader_.blocking(beam_.axes.at(along, (first_u >> 2) + u, v >> 2));
        any |= words[static_cast<std::size_t>(u)];
      }
      any_of_layer |= any;
      if (any == 0) {
        continue;
      }
      compiled_for(set_, [&words, major = beam_.axes.major] {
        VANTAGE_INDEPENDENT
        for (std::size_t i = 0; i < words.size(); ++i) {
          words[i] = in_slices(words[i], major);
        }
      });
      const WordRows of_words = rows_of_words(std::span(words).first(static_cast<std::size_t>(width)), set_);
      for (std::size_t i = 0; i < of_words.size(); ++i) {
        const std::size_t at = i / 4 * layer.rows + static_cast<std::size_t>(v - layer.first_v) + i % 4;
        const std::size_t of_any = at + (kAny - i / 4) * layer.rows;
        rows[at] |= of_words[i];
        rows[of_any] |= of_words[i];
        // Columns overlap: the first 32 cells of this one are the last 32 of the one before.
        if (column > 0) {
          std::uint64_t* const before = rows - kPlanes * layer.rows;
          before[at] |= std::uint64_t{of_words[i]} << 32U;
          before[of_any] |= std::uint64_t{of_words[i]} << 32U;
        }
      }
    }
  }
  return any_of_layer != 0;
}

VANTAGE_INLINE bool ViewSlices::any_stops(std::int64_t slice, const LateralCells& cells) const {
  const Layer& layer = layers_[number_of(slice)];
  const std::int32_t column = (cells.lo[0] - layer.first_u) / kColumn;
  const std::int32_t lo = cells.lo[0] - layer.first_u - column * kColumn;
  const std::int32_t hi = lo + cells.extent(0) - 1;
  if (hi >= 2 * kColumn) {
    return true;  // wider than one row of 64 cells, so the answer is not known
  }
  const std::uint64_t* const rows = rows_of(layer, column, kAny) + (cells.lo[1] - layer.first_v);
  const std::uint64_t columns = ~std::uint64_t{0} << lo & ~std::uint64_t{0} >> (63 - hi);
#if defined(__x86_64__)
  if (set_ == InstructionSet::Avx512) {
    return any_in_rows_avx512(rows, cells.extent(1), columns);
  }
#endif
  return any_in_rows(rows, cells.extent(1), columns);
}

// Skips free layers, then asks layer by layer. A layer that does not cover the cells of the beam cannot answer: it is
// a stop that is not held.
VANTAGE_INLINE Stop ViewSlices::next_stop(const SliceBeam& beam, std::int64_t slice) {
  const auto stops = [this](const Stop& stop) { return !stop.held || any_stops(stop.slice, stop.cells); };
  while (slice <= last_) {
    if (const std::int32_t free = free_layers(slice); free > 0) {
      slice += beam.left_in_layer(slice) + std::int64_t{4} * (free - 1);
      continue;
    }
    if (slice == 0) {  // rays start inside slice 0, so they pass only a part of it
      const LateralCells cells = beam.cells_in(0, 0);
      if (const Stop stop{0, 1, cells, hold(0, cells)}; stops(stop)) {
        return stop;
      }
      slice = 1;
      continue;
    }
    const LateralLayers cells = beam.layers_from(slice, set_);
    for (std::size_t k = 0; k < LateralLayers::kLayers && slice <= last_; ++k) {
      const std::int64_t next = slice + beam.left_in_layer(slice);
      if (free_layers(slice) == 0) {
        if (const Stop stop{slice, next, cells[k], hold(slice, cells[k])}; stops(stop)) {
          return stop;
        }
      }
      slice = next;
    }
  }
  return {slice};
}

VANTAGE_INLINE void ViewSlices::cut(const SliceBeam& beam, const Stop& stop, SliceWindows& windows) const {
  const LateralCells& cells = stop.cells;
  SlicePlace& place = windows.place;
  place = {beam.axes, 0, cells.lo[0] & ~3, cells.lo[1] & ~3};
  const Layer& layer = layers_[number_of(stop.slice)];
  const std::int32_t column = (place.first_u - layer.first_u) / kColumn;
  const auto shift = static_cast<unsigned>(place.first_u - layer.first_u - column * kColumn);
  const std::int32_t from_row = place.first_v - layer.first_v;
  const WindowPatch patch = patch_of(cells, place);
  windows.first = stop.next;
  std::int64_t last = stop.slice - 1;
  const auto cut_all = [&](const auto& cut_one) {
    std::size_t count = 0;  // windows before the first one that stops a ray are overwritten
    for (std::int64_t slice = stop.slice; slice < stop.next; ++slice) {
      const std::uint64_t* const from = rows_of(layer, column, beam_.along(slice) & 3) + from_row;
      if (cut_one(from, windows.rows[count].data())) {
        windows.first = std::min(windows.first, slice);
        last = slice;
      }
      count += last >= stop.slice ? 1 : 0;
    }
    windows.count = static_cast<std::size_t>(std::max<std::int64_t>(last - windows.first + 1, 0));
    place.along = beam.along(windows.first);
  };
#if defined(__x86_64__)
  if (set_ == InstructionSet::Avx512) {
    cut_all([&](const std::uint64_t* from, std::uint32_t* to) { return cut_window_avx512(from, shift, patch, to); });
    return;
  }
#endif
  compiled_for(set_, [&] {
    cut_all([&](const std::uint64_t* from, std::uint32_t* to) { return cut_window(from, shift, patch, to); });
  });
}

VANTAGE_INLINE Stop GridSlices::next_stop(const SliceBeam& beam, std::int64_t slice) {
  while (slice <= last_) {
    const std::int32_t count = beam.left_in_layer(slice);
    const LateralCells cells = beam.cells_in(slice, slice + count - 1);
    const std::int32_t free = free_layers(beam.axes, cells, beam.along(slice) >> 2);
    if (free == 0) {
      // Rays start inside slice 0, so they pass only a part of it.
      return {slice, slice == 0 ? 1 : slice + count, cells};
    }
    slice += count + 4 * (free - 1);
  }
  return {slice};
}

// Number of layers, from this one on, that rays can cross freely after they have entered the words of these cells. It
// relies on the fact that no ray moves further sideways than forwards.
VANTAGE_INLINE std::int32_t GridSlices::free_layers(const SliceAxes& axes, const LateralCells& cells,
                                                    std::int32_t along) {
  std::int32_t layers = BlockingGrid::kFurthest;
  for (std::int32_t v = cells.lo[1] >> 2; v <= cells.hi[1] >> 2; ++v) {
    for (std::int32_t u = cells.lo[0] >> 2; u <= cells.hi[0] >> 2; ++u) {
      layers = std::min<std::int32_t>(layers, reader_.distance(axes.at(along, u, v)));
      if (layers == 0) {
        return 0;
      }
    }
  }
  return layers;
}

// Rows beyond the words of the stop keep old values, but no ray gets there.
VANTAGE_INLINE void GridSlices::cut(const SliceBeam& beam, const Stop& stop, SliceWindows& windows) {
  const LateralCells& cells = stop.cells;
  SlicePlace& place = windows.place;
  place = {beam.axes, beam.along(stop.slice), cells.lo[0] & ~3, cells.lo[1] & ~3};
  windows.first = stop.slice;
  const auto count = static_cast<std::size_t>(stop.next - stop.slice);
  const VoxelIndex lo = place.at(place.along >> 2, place.first_u >> 2, place.first_v >> 2);
  const std::int32_t u_words = (cells.hi[0] >> 2) - (cells.lo[0] >> 2);
  const std::int32_t v_words = (cells.hi[1] >> 2) - (cells.lo[1] >> 2);
  // The slices of a word are brought into the order of the walk. Then those before the stop are shifted out, and
  // those behind it masked.
  const std::uint64_t taken = ~std::uint64_t{0} >> (64U - 16U * count);
  const auto skipped = static_cast<unsigned>(place.up ? place.along & 3 : 3 - (place.along & 3)) * 16U;
  std::array<std::uint64_t, SliceWindows::kWidth / 4> words;
  for (std::int32_t v = 0; v <= v_words; ++v) {
    for (std::int32_t u = 0; u <= u_words; ++u) {
      const std::uint64_t slices = in_slices(reader_.blocking(lo + place.at(0, u, v)), place.major);
      words[static_cast<std::size_t>(u)] = (place.up ? slices : reversed(slices)) >> skipped & taken;
    }
    const WordRows rows = rows_of_words(std::span(words).first(static_cast<std::size_t>(u_words) + 1), set_);
    for (std::size_t i = 0; i < SliceWindows::kMost; ++i) {
      std::copy_n(&rows[4 * i], 4, &windows.rows[i][static_cast<std::size_t>(v) * 4]);
    }
  }
  windows.count = slices_with(patch_of(cells, place), windows.rows, set_) != 0 ? count : 0;
}

}  // namespace vantage::detail
