// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/grazed_cells.hpp>
#include <vector>

namespace vantage {
namespace detail {

inline bool touches_a_hit(const OccupancyMap& map, const ScanMarks& marks, const VoxelIndex& cell) {
  for (std::int32_t z = -1; z <= 1; ++z) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t x = -1; x <= 1; ++x) {
        const VoxelIndex other = cell + VoxelIndex{x, y, z};
        if (map.in_region(other) && marks.is_hit(other)) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace detail

VANTAGE_INLINE void unmark_grazed_cells(const Eigen::Vector3d& origin, const OccupancyMap& map, ScanMarks& marks) {
  const VoxelIndex sensor = map.frame().cell_of(origin);
  std::vector<VoxelIndex> kept;
  marks.for_each_marked_brick([&](const VoxelIndex& address, const std::uint64_t* passed, const std::uint64_t* hit) {
    const Brick* brick = map.find_brick(address);
    for (std::size_t word = 0; brick != nullptr && word < Brick::kWords; ++word) {
      for_each_offset(passed[word] & ~hit[word] & brick->occupied[word], word, [&](std::size_t offset) {
        const VoxelIndex cell = Brick::cell_at(address, offset);
        if (beyond_erase_range(map.options(), sensor, cell) || detail::touches_a_hit(map, marks, cell)) {
          kept.push_back(cell);
        }
      });
    }
  });
  for (const VoxelIndex& cell : kept) {
    marks.unmark_passed(cell);
  }
}

}  // namespace vantage
