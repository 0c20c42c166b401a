// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/voxel_ray.hpp>
#include <vantage/map/impl/grazed_cells.hpp>
#include <vector>

namespace vantage::detail {

// Calls `visit(end, is_return)` for the end point of every drawn ray.
template <class Visit>
void for_each_end(const ScanRays& rays, const VoxelFrame& frame, RayPolicy policy, const ScanMarks& marks,
                  Visit&& visit) {
  const bool to_centres = policy == RayPolicy::EachEndCell;
  if (to_centres) {
    marks.for_each_marked_brick([&](const VoxelIndex& address, const std::uint64_t*, const std::uint64_t* hit) {
      for (std::size_t word = 0; word < Brick::kWords; ++word) {
        for_each_offset(hit[word], word,
                        [&](std::size_t offset) { visit(frame.centre_of(Brick::cell_at(address, offset)), true); });
      }
    });
  }
  RayBlock block;
  for (std::size_t number = 0; number < rays.blocks(); ++number) {
    rays.block(number, 1, block);
    for (std::size_t i = 0; i < RayBlock::kRays && !(to_centres && block.all_hit()); ++i) {
      if (block.usable(i) && !(to_centres && block.hits(i))) {
        visit(Eigen::Vector3d(block.end[0][i], block.end[1][i], block.end[2][i]), block.hits(i));
      }
    }
  }
}

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

VANTAGE_INLINE void unmark_grazed_cells(const ScanRays& rays, const OccupancyMap& map, RayPolicy policy,
                                        ScanMarks& marks) {
  for_each_end(rays, map.frame(), policy, marks, [&](const Eigen::Vector3d& end, bool is_return) {
    const VoxelIndex last = map.frame().cell_of(end);
    (void)VoxelRay(map.frame(), rays.origin(), end).all_from_the_end([&](const VoxelIndex& cell) {
      const bool in_surface = map.at(cell) == Occupancy::Occupied;
      if (in_surface) {
        marks.unmark_passed(cell);
      }
      return in_surface || (is_return && cell == last);
    });
  });
  const VoxelIndex sensor = map.frame().cell_of(rays.origin());
  std::vector<VoxelIndex> kept;
  marks.for_each_marked_brick([&](const VoxelIndex& address, const std::uint64_t* passed, const std::uint64_t* hit) {
    const Brick* brick = map.find_brick(address);
    for (std::size_t word = 0; brick != nullptr && word < Brick::kWords; ++word) {
      for_each_offset(passed[word] & ~hit[word] & brick->occupied[word], word, [&](std::size_t offset) {
        const VoxelIndex cell = Brick::cell_at(address, offset);
        if (beyond_erase_range(map.options(), sensor, cell) || touches_a_hit(map, marks, cell)) {
          kept.push_back(cell);
        }
      });
    }
  });
  for (const VoxelIndex& cell : kept) {
    marks.unmark_passed(cell);
  }
}

}  // namespace vantage::detail
