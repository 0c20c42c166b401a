// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <raytrace/slice_lanes.hpp>
#include <vantage/geometry/voxel.hpp>
#include <vantage/raytrace/cell_set.hpp>

namespace vantage {

/// Where the windows of a few slices lie in the world.
struct SlicePlace {
  std::size_t major = 0;     ///< axis across which the slices are
  std::size_t u = 1;         ///< the lateral axes
  std::size_t v = 2;         ///< and the second
  bool up = true;            ///< whether the next slice is the higher one
  std::int32_t along = 0;    ///< first slice, as a coordinate of cells
  std::int32_t first_u = 0;  ///< cell of the first column of the windows, that of a word
  std::int32_t first_v = 0;  ///< cell of their first row, that of a word

  /// A cell, or a word, by its coordinates along these axes.
  [[nodiscard]] VoxelIndex at(std::int32_t m, std::int32_t of_u, std::int32_t of_v) const {
    return major == 0   ? VoxelIndex{m, of_u, of_v}
           : major == 1 ? VoxelIndex{of_u, m, of_v}
                        : VoxelIndex{of_u, of_v, m};
  }
};

/// Takes what the rays of a tile meet.
class HitSink {
 public:
  HitSink() = default;
  virtual ~HitSink() = default;
  /// Rays that were stopped in slices.
  virtual void take(const SliceHits& hits, const SlicePlace& place) = 0;
  /// One that was stopped by a cell.
  virtual void take(std::size_t ray, const VoxelIndex& cell) = 0;

 protected:
  HitSink(const HitSink&) = default;
  HitSink(HitSink&&) = default;
  HitSink& operator=(const HitSink&) = default;
  HitSink& operator=(HitSink&&) = default;
};

/// Where rays were stopped.
class TileHits final : public HitSink {
 public:
  explicit TileHits(InstructionSet set) : set_(set) {}
  void take(const SliceHits& hits, const SlicePlace& place) override;
  void take(std::size_t ray, const VoxelIndex& cell) override;

  /// The cell that stopped a ray.
  [[nodiscard]] VoxelIndex cell_at(std::size_t ray) const { return {cell[0][ray], cell[1][ray], cell[2][ray]}; }

  std::uint64_t stopped = 0;                                         ///< a bit for each ray that was
  alignas(64) std::array<RayBlock::PerRay<std::int32_t>, 3> cell{};  ///< by which cell

 private:
  InstructionSet set_;
};

/// The cells that stopped rays, each once, whichever rays those were.
class CellStamps final : public HitSink {
 public:
  /// Of a box; into `seen`, which must outlive it.
  CellStamps(CellSet& seen, InstructionSet set) : seen_(&seen), set_(set) {}
  void take(const SliceHits& hits, const SlicePlace& place) override;
  void take(std::size_t ray, const VoxelIndex& cell) override;

 private:
  CellSet* seen_;
  InstructionSet set_;
  // Of the windows, which hold 8 x 4 words, the cells that stopped rays, by slices; zero between calls.
  std::array<std::uint64_t, 32> words_{};
};

}  // namespace vantage
