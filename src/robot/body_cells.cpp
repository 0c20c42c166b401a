// SPDX-License-Identifier: MIT
#include "robot/body_cells.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>
#include <vantage/geometry/raster_order.hpp>

namespace vantage::detail {
namespace {

// The clear cells of a box, as 1.
VoxelGrid<std::uint8_t> clear_cells_of(const OccupancyMap& map, const VoxelBox& box) {
  VoxelGrid<std::uint8_t> clear(box);
  map.for_each_clear([&](const VoxelIndex& cell) {
    if (box.contains(cell)) {
      clear[cell] = 1;
    }
  });
  return clear;
}

// Cells beside which (26 neighbours) one is clear, or that are clear, as 1: spread by a cell along x, then y, then z.
std::vector<std::uint8_t> beside_clear(const VoxelGrid<std::uint8_t>& clear) {
  std::vector<std::uint8_t> spread = clear.values();
  const VoxelIndex extent = clear.box().extent();
  const auto row = static_cast<std::size_t>(extent.x);
  const std::array<std::size_t, 3> strides{1, row, row * static_cast<std::size_t>(extent.y)};
  std::vector<std::uint8_t> before;
  for (const std::size_t stride : strides) {
    before = spread;
    // Along x and y a cell at the end of its line also marks the first of the next: one more to look at, no harm.
    for (std::size_t i = stride; i < spread.size(); ++i) {
      spread[i] |= before[i - stride];
      spread[i - stride] |= before[i];
    }
  }
  return spread;
}

// Cells of a row, from `first`, as many as `length`.
struct Run {
  VoxelIndex first;
  std::int32_t length = 0;
};

std::vector<Run> runs_of(std::vector<VoxelIndex> cells) {
  std::sort(cells.begin(), cells.end(), RasterOrder{});
  std::vector<Run> runs;
  for (const VoxelIndex& cell : cells) {
    if (!runs.empty() && cell == runs.back().first + VoxelIndex{runs.back().length, 0, 0}) {
      ++runs.back().length;
    } else {
      runs.push_back({cell, 1});
    }
  }
  return runs;
}

std::int32_t reach_of(const std::vector<VoxelIndex>& touched) {
  std::int32_t reach = 0;
  for (const VoxelIndex& cell : touched) {
    reach = std::max({reach, std::abs(cell.x), std::abs(cell.y), std::abs(cell.z)});
  }
  return reach;
}

}  // namespace

VoxelGrid<std::uint8_t> cells_for_body(const OccupancyMap& map, const VoxelBox& box,
                                       const std::vector<VoxelIndex>& touched) {
  const VoxelGrid<std::uint8_t> clear = clear_cells_of(map, box.grown(reach_of(touched)));
  VoxelGrid<std::uint8_t> fits(box);
  for_each_cell(box, [&](const VoxelIndex& cell) { fits[cell] = clear[cell]; });
  // What a centre must not be, seen from a cell that is not clear: the body turned about its centre, row by row.
  std::vector<VoxelIndex> forbidden(touched.size());
  std::transform(touched.begin(), touched.end(), forbidden.begin(),
                 [](const VoxelIndex& offset) { return VoxelIndex{} - offset; });
  const std::vector<Run> runs = runs_of(std::move(forbidden));
  const std::vector<std::uint8_t> beside = beside_clear(clear);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    // Deep inside what is not clear there is no centre left to forbid.
    if (clear.values()[i] != 0 || beside[i] == 0) {
      continue;
    }
    const VoxelIndex cell = clear.cell_at(i);
    for (const Run& run : runs) {
      const VoxelIndex first = cell + run.first;
      const std::int32_t from = std::max(first.x, box.lo.x);
      const std::int32_t to = std::min(first.x + run.length, box.hi.x);
      if (from < to && first.y >= box.lo.y && first.y < box.hi.y && first.z >= box.lo.z && first.z < box.hi.z) {
        const auto at = fits.values().begin() + static_cast<std::ptrdiff_t>(fits.offset_of({from, first.y, first.z}));
        std::fill_n(at, to - from, std::uint8_t{0});
      }
    }
  }
  return fits;
}

}  // namespace vantage::detail
