// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map/grazed_cells.hpp>
#include <vector>

namespace vantage {
namespace {

bool touches_a_hit(const ScanMarks& marks, const VoxelIndex& cell) {
  for (std::int32_t z = -1; z <= 1; ++z) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t x = -1; x <= 1; ++x) {
        if (marks.is_hit(cell + VoxelIndex{x, y, z})) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

void unmark_grazed_cells(const OccupancyMap& map, ScanMarks& marks) {
  std::vector<VoxelIndex> grazed;
  marks.for_each_marked_brick([&](const VoxelIndex& address, const std::uint64_t* passed, const std::uint64_t* hit) {
    const Brick* brick = map.find_brick(address);
    for (std::size_t word = 0; brick != nullptr && word < Brick::kWords; ++word) {
      for_each_offset(passed[word] & ~hit[word] & brick->occupied[word], word, [&](std::size_t offset) {
        const VoxelIndex cell = Brick::first_cell(address) + Brick::cell_at(offset);
        if (touches_a_hit(marks, cell)) {
          grazed.push_back(cell);
        }
      });
    }
  });
  std::for_each(grazed.begin(), grazed.end(), [&](const VoxelIndex& cell) { marks.unmark_passed(cell); });
}

}  // namespace vantage
