// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vantage/map/occupancy.hpp>
#include <vector>

namespace vantage::test {

/// The map of a host that knows nothing of vantage but the question: a dense grid that throws if it is asked for a
/// cell that it does not hold.
class GridHost {
 public:
  explicit GridHost(const VoxelBox& box) : box_(box), cells_(box.size(), Occupancy::Unknown) {}

  [[nodiscard]] const VoxelBox& box() const { return box_; }
  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const { return cells_[number_of(cell)]; }
  void set(const VoxelIndex& cell, Occupancy state) { cells_[number_of(cell)] = state; }

 private:
  [[nodiscard]] std::size_t number_of(const VoxelIndex& cell) const {
    if (!box_.contains(cell)) {
      throw std::out_of_range("asked for a cell outside the grid");
    }
    const VoxelIndex at = cell - box_.lo;
    const VoxelIndex extent = box_.extent();
    return static_cast<std::size_t>((at.z * extent.y + at.y) * extent.x + at.x);
  }

  VoxelBox box_;
  std::vector<Occupancy> cells_;
};

/// A box of random cells and edges inside `box`.
inline VoxelBox random_box_in(const VoxelBox& box, std::int32_t most, std::mt19937& engine) {
  const VoxelIndex extent = box.extent();
  const auto draw = [&](std::int32_t below) {
    return static_cast<std::int32_t>(engine() % static_cast<std::uint32_t>(below));
  };
  const VoxelIndex lo = box.lo + VoxelIndex{draw(extent.x), draw(extent.y), draw(extent.z)};
  return {lo,
          {std::min(lo.x + 1 + draw(most), box.hi.x), std::min(lo.y + 1 + draw(most), box.hi.y),
           std::min(lo.z + 1 + draw(most), box.hi.z)}};
}

/// Changes a random box of the grid to one state, mostly free, or to random ones. Returns the box.
inline VoxelBox change(GridHost& host, std::mt19937& engine) {
  const VoxelBox box = random_box_in(host.box(), 14, engine);
  const std::size_t kind = engine() % 8;
  for_each_cell(box, [&](const VoxelIndex& cell) {
    host.set(cell, static_cast<Occupancy>(kind < 4 ? 1 : kind == 4 ? 0 : kind == 5 ? 2 : engine() % 3));
  });
  return box;
}

}  // namespace vantage::test
