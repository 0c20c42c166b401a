// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vantage/map/impl/lane_queries.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>
#include <vantage/raytrace/impl/slice_windows.hpp>

namespace vantage::detail {

/// Receives the cells that stop the rays of a tile.
class HitSink {
 public:
  HitSink() = default;
  virtual ~HitSink() = default;
  /// Adds the rays stopped in slices. The value of `hits.where` must be -1 for rays that are not stopped.
  virtual void take(const SliceHits& hits, const SlicePlace& place) = 0;
  /// Adds a single ray stopped by `cell`.
  virtual void take(std::size_t ray, const VoxelIndex& cell) = 0;

 protected:
  HitSink(const HitSink&) = default;
  HitSink(HitSink&&) = default;
  HitSink& operator=(const HitSink&) = default;
  HitSink& operator=(HitSink&&) = default;
};

/// Stores for each ray the cell that stops it.
class TileHits final : public HitSink {
 public:
  explicit TileHits(InstructionSet set) : set_(set) {}
  void take(const SliceHits& hits, const SlicePlace& place) override;
  void take(std::size_t ray, const VoxelIndex& cell) override;

  /// The cell that stops a ray.
  [[nodiscard]] VoxelIndex cell_at(std::size_t ray) const { return {cell[0][ray], cell[1][ray], cell[2][ray]}; }

  std::uint64_t stopped = 0;                                         ///< bit mask of the stopped rays
  alignas(64) std::array<RayBlock::PerRay<std::int32_t>, 3> cell{};  ///< coordinates of their cells, per axis

 private:
  InstructionSet set_;
};

/// Collects the distinct cells that stop rays.
class CellStamps final : public HitSink {
 public:
  /// Adds the cells to `seen`, which must outlive the object. Cells outside its box are dropped.
  CellStamps(CellSet& seen, InstructionSet set) : seen_(&seen), set_(set) {}
  void take(const SliceHits& hits, const SlicePlace& place) override;
  void take(std::size_t ray, const VoxelIndex& cell) override;

 private:
  CellSet* seen_;
  InstructionSet set_;
  // The stopping cells of the current windows, as 8 x 4 words ordered by slices. All zero between calls.
  std::array<std::uint64_t, 32> words_{};
};

inline void TileHits::take(const SliceHits& hits, const SlicePlace& place) {
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
    // Without branches: a ^ ((a ^ b) & mask) is b where the mask is set, and a elsewhere.
    VANTAGE_INDEPENDENT
    for (std::size_t i = 0; i < RayBlock::kRays; ++i) {
      const std::int32_t at = where[i];
      const std::int32_t is_new = ~(at >> 31);  // all bits set, or none
      cell_m[i] ^= (cell_m[i] ^ (along + step * SliceHits::slice(at))) & is_new;
      cell_u[i] ^= (cell_u[i] ^ (first_u + SliceHits::column(at))) & is_new;
      cell_v[i] ^= (cell_v[i] ^ (first_v + SliceHits::row(at))) & is_new;
    }
  });
}

inline void TileHits::take(std::size_t ray, const VoxelIndex& by) {
  stopped |= std::uint64_t{1} << ray;
  cell[0][ray] = by.x;
  cell[1][ray] = by.y;
  cell[2][ray] = by.z;
}

// Neighbouring rays stop at the same cell, so only the first ray of a run is used.
inline void CellStamps::take(const SliceHits& hits, const SlicePlace& place) {
  std::uint32_t touched = 0;
  for (std::uint64_t left = hits.stopped & changes_of(hits.where, set_); left != 0; left &= left - 1) {
    const std::int32_t where = hits.where[static_cast<std::size_t>(std::countr_zero(left))];
    const VoxelIndex cell{SliceHits::column(where), SliceHits::row(where),
                          place.along + (place.up ? SliceHits::slice(where) : -SliceHits::slice(where))};
    // `cell` is (u, v, major axis), so its bit follows the order of slices until from_slices.
    const std::int32_t word = cell.x >> 2 | cell.y >> 2 << 3;
    words_[static_cast<std::size_t>(word)] |= CellSet::bit_of(cell);
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

inline void CellStamps::take(std::size_t /*ray*/, const VoxelIndex& cell) { seen_->insert(cell); }

}  // namespace vantage::detail
