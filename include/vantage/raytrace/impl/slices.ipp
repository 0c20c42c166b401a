// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <vantage/raytrace/impl/slices.hpp>

namespace vantage::detail {

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

VANTAGE_INLINE Stop Slices::next_stop(const SliceBeam& beam, std::int64_t from, std::int64_t last) {
  while (from <= last) {
    const std::int32_t count = beam.left_in_layer(from);
    const LateralCells cells = beam.cells_in(from, from + count - 1);
    const std::int32_t free = free_layers(beam.axes, cells, beam.along(from) >> 2);
    if (free == 0) {
      // Rays start inside slice 0, so they pass only a part of it.
      return {from, from == 0 ? 1 : from + count, cells};
    }
    from += count + 4 * (free - 1);
  }
  return {from};
}

// Number of layers, from this one on, that rays can cross freely after they have entered the words of these cells. It
// relies on the fact that no ray moves further sideways than forwards.
VANTAGE_INLINE std::int32_t Slices::free_layers(const SliceAxes& axes, const LateralCells& cells,
                                                std::int32_t along) {
  const VoxelIndex by_u = axes.at(0, 1, 0);
  const VoxelIndex by_v = axes.at(0, 0, 1);
  const std::int32_t u_words = (cells.hi[0] >> 2) - (cells.lo[0] >> 2);
  const std::int32_t v_words = (cells.hi[1] >> 2) - (cells.lo[1] >> 2);
  std::int32_t layers = BlockingGrid::kFurthest;
  VoxelIndex row = axes.at(along, cells.lo[0] >> 2, cells.lo[1] >> 2);
  for (std::int32_t v = 0; v <= v_words; ++v, row = row + by_v) {
    VoxelIndex word = row;
    for (std::int32_t u = 0; u <= u_words; ++u, word = word + by_u) {
      layers = std::min<std::int32_t>(layers, reader_.distance(word));
      if (layers == 0) {
        return 0;
      }
    }
  }
  return layers;
}

// Rows beyond the words of the stop keep old values, but no ray gets there.
VANTAGE_INLINE void Slices::cut(const SliceBeam& beam, const Stop& stop, SliceWindows& windows) {
  const LateralCells& cells = stop.cells;
  SlicePlace& place = windows.place;
  place = {beam.axes, beam.along(stop.slice), cells.lo[0] & ~3, cells.lo[1] & ~3};
  const VoxelIndex lo = place.at(place.along >> 2, place.first_u >> 2, place.first_v >> 2);
  const std::int32_t u_words = (cells.hi[0] >> 2) - (cells.lo[0] >> 2);
  const std::int32_t v_words = (cells.hi[1] >> 2) - (cells.lo[1] >> 2);
  // The slices of a word are brought into the order of the walk. Then those before the stop are shifted out, and
  // those behind it masked.
  const std::uint64_t taken = ~std::uint64_t{0} >> (64U - 16U * static_cast<unsigned>(stop.next - stop.slice));
  const auto skipped = static_cast<unsigned>(place.up ? place.along & 3 : 3 - (place.along & 3)) * 16U;
  std::array<std::uint64_t, SliceWindows::kWidth / 4> words{};
  for (std::int32_t v = 0; v <= v_words; ++v) {
    std::uint64_t any = 0;
    for (std::int32_t u = 0; u <= u_words; ++u) {
      const std::uint64_t word = reader_.blocking(lo + place.at(0, u, v));
      words[static_cast<std::size_t>(u)] = word;
      any |= word;
    }
    WordRows rows{};
    if (any != 0) {
      compiled_for(set_, [of = words.data(), major = place.major, up = place.up, skipped, taken] {
        VANTAGE_INDEPENDENT
        for (std::size_t i = 0; i < SliceWindows::kWidth / 4; ++i) {
          const std::uint64_t slices = in_slices(of[i], major);
          of[i] = (up ? slices : reversed(slices)) >> skipped & taken;
        }
      });
      rows = rows_of_words(std::span(words).first(static_cast<std::size_t>(u_words) + 1), set_);
    }
    for (std::size_t i = 0; i < SliceWindows::kMost; ++i) {
      std::copy_n(&rows[4 * i], 4, &windows.rows[i][static_cast<std::size_t>(v) * 4]);
    }
  }
  const std::uint32_t stopping = slices_with(patch_of(cells, place), windows.rows, set_);
  const std::int32_t before = stopping == 0 ? 0 : std::countr_zero(stopping);
  windows.count = static_cast<std::size_t>(static_cast<std::int32_t>(std::bit_width(stopping)) - before);
  windows.first = stop.slice + before;
  place.along = beam.along(windows.first);
  if (before > 0) {
    std::copy_n(windows.rows.begin() + before, windows.count, windows.rows.begin());
  }
}

}  // namespace vantage::detail
