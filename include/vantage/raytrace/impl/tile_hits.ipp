// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/raytrace/impl/sliced_words.hpp>
#include <vantage/raytrace/impl/tile_hits.hpp>

namespace vantage {

VANTAGE_INLINE void TileHits::take(const SliceHits& hits, const SlicePlace& place) {
  stopped |= hits.stopped;
  compiled_for(set_, [this, &hits, &place] {
    const std::int32_t along = place.along;
    const std::int32_t step = place.up ? 1 : -1;
    const std::int32_t first_u = place.first_u;
    const std::int32_t first_v = place.first_v;
    const std::int32_t* const where = hits.where.data();
    std::int32_t* const cell_m = cell[place.major].data();
    std::int32_t* const cell_u = cell[place.u].data();
    std::int32_t* const cell_v = cell[place.v].data();
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      const std::int32_t at = where[i];
      const std::int32_t is_new = ~(at >> 31);  // all bits set, or none
      cell_m[i] ^= (cell_m[i] ^ (along + step * (at >> 9))) & is_new;
      cell_u[i] ^= (cell_u[i] ^ (first_u + (at & (SliceWindows::kWidth - 1)))) & is_new;
      cell_v[i] ^= (cell_v[i] ^ (first_v + (at >> 5 & (SliceWindows::kHeight - 1)))) & is_new;
    }
  });
}

VANTAGE_INLINE void TileHits::take(std::size_t ray, const VoxelIndex& by) {
  stopped |= std::uint64_t{1} << ray;
  cell[0][ray] = by.x;
  cell[1][ray] = by.y;
  cell[2][ray] = by.z;
}

// Neighbouring rays stop at the same cell, so only the first ray of a run is used.
VANTAGE_INLINE void CellStamps::take(const SliceHits& hits, const SlicePlace& place) {
  const auto first_slice = static_cast<std::uint32_t>(place.along & 3);
  std::uint32_t touched = 0;
  for (std::uint64_t left = hits.stopped & changes_of(hits.where, set_); left != 0; left &= left - 1) {
    const auto where = static_cast<std::uint32_t>(hits.where[static_cast<std::size_t>(std::countr_zero(left))]);
    const std::uint32_t word = (where >> 2U & 7U) | (where >> 4U & 24U);
    const std::uint32_t slice = place.up ? first_slice + (where >> 9U) : first_slice - (where >> 9U);
    words_[word] |= std::uint64_t{1} << ((where & 3U) | (where >> 3U & 12U) | slice << 4U);
    touched |= std::uint32_t{1} << word;
  }
  for (; touched != 0; touched &= touched - 1) {
    const auto word = static_cast<std::uint32_t>(std::countr_zero(touched));
    const auto u = static_cast<std::int32_t>(word & 7U);
    const auto v = static_cast<std::int32_t>(word >> 3U);
    seen_->insert_word(place.at(place.along >> 2, (place.first_u >> 2) + u, (place.first_v >> 2) + v),
                       from_slices(words_[word], place.major));
    words_[word] = 0;
  }
}

VANTAGE_INLINE void CellStamps::take(std::size_t /*ray*/, const VoxelIndex& cell) { seen_->insert(cell); }

}  // namespace vantage
