// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vantage/raytrace/impl/grid_slices.hpp>
#include <vantage/raytrace/impl/sliced_word.hpp>
#include <vantage/raytrace/impl/word_rows.hpp>

namespace vantage {
namespace detail {

// Reverses the order of the slices in a word (see in_slices).
inline std::uint64_t reversed(std::uint64_t slices) {
  slices = slices << 32U | slices >> 32U;
  return (slices & 0x0000FFFF0000FFFFU) << 16U | (slices >> 16U & 0x0000FFFF0000FFFFU);
}

}  // namespace detail

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
  const std::uint32_t columns = ~std::uint32_t{0} << (cells.lo[0] & 3) &
                                ~std::uint32_t{0} >> (SliceWindows::kWidth - 1 - (cells.hi[0] - place.first_u));
  const std::uint64_t taken = ~std::uint64_t{0} >> (64U - 16U * count);
  const auto skipped = static_cast<unsigned>(place.up ? place.along & 3 : 3 - (place.along & 3)) * 16U;
  std::array<std::uint64_t, SliceWindows::kWidth / 4> words;
  std::uint32_t any = 0;
  for (std::int32_t v = 0; v <= v_words; ++v) {
    for (std::int32_t u = 0; u <= u_words; ++u) {
      const std::uint64_t slices = in_slices(reader_.blocking(lo + place.at(0, u, v)), place.major);
      words[static_cast<std::size_t>(u)] = (place.up ? slices : detail::reversed(slices)) >> skipped & taken;
    }
    const WordRows rows = rows_of_words(std::span(words).first(static_cast<std::size_t>(u_words) + 1), set_);
    const std::int32_t first = place.first_v + v * 4;
    for (std::size_t i = 0; i < SliceWindows::kMost; ++i) {
      std::copy_n(&rows[4 * i], 4, &windows.rows[i][static_cast<std::size_t>(v) * 4]);
      for (std::int32_t r = 0; r < 4; ++r) {
        const bool is_met = cells.lo[1] <= first + r && first + r <= cells.hi[1];
        any |= is_met ? rows[4 * i + static_cast<std::size_t>(r)] : 0;
      }
    }
  }
  windows.count = (any & columns) != 0 ? count : 0;
}

}  // namespace vantage
