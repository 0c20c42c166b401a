// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/cell_set.hpp>
#include <vantage/raytrace/impl/slice_lanes.hpp>

namespace vantage {

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

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/raytrace/impl/tile_hits.ipp>
#endif
