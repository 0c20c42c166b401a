// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/robot/impl/body_cells.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include <vantage/geometry/impl/cell_rows.hpp>

namespace vantage::detail {

inline CellRows clear_rows(const OccupancyMap& map, const VoxelBox& bricks) {
  CellRows clear(Brick::cells_of(bricks));
  for_each_cell(bricks, [&](const VoxelIndex& address) {
    const Brick* brick = map.find_brick(address);
    if (brick == nullptr) {
      return;
    }
    const BrickPlane plane = map.clear_plane(*brick);
    for (std::size_t word = 0; word < Brick::kWords; ++word) {
      const VoxelIndex first = Brick::cell_at(address, 64 * word);
      for (std::int32_t row = 0; row < 16 && plane[word] != 0; ++row) {
        clear.insert_four(first + VoxelIndex{0, row & 3, row >> 2}, plane[word] >> (4 * row) & 0xFU);
      }
    }
  });
  return clear;
}

inline std::int32_t reach_of(const std::vector<VoxelIndex>& touched) {
  std::int32_t reach = 0;
  for (const VoxelIndex& cell : touched) {
    reach = std::max({reach, std::abs(cell.x), std::abs(cell.y), std::abs(cell.z)});
  }
  return reach;
}

// Rows (y, z) of a body, grouped by the cells that they touch along x. A sphere has few different ones.
using RowsOfBody = std::map<std::vector<std::int32_t>, std::vector<std::pair<std::int32_t, std::int32_t>>>;

inline RowsOfBody rows_of_body(const std::vector<VoxelIndex>& touched) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> rows;
  for (const VoxelIndex& cell : touched) {
    rows[{cell.y, cell.z}].push_back(cell.x);
  }
  RowsOfBody alike;
  for (auto& [row, steps] : rows) {
    std::sort(steps.begin(), steps.end());
    alike[steps].push_back(row);
  }
  return alike;
}

inline bool is_empty_row(std::span<const std::uint64_t> row) {
  return std::all_of(row.begin(), row.end(), [](std::uint64_t word) { return word == 0; });
}

// The cells from which all cells at these steps along x are clear; at least one step.
inline CellRows clear_along(const CellRows& clear, const std::vector<std::int32_t>& steps) {
  CellRows along(clear.box());
  for (std::int32_t z = clear.box().lo.z; z < clear.box().hi.z; ++z) {
    for (std::int32_t y = clear.box().lo.y; y < clear.box().hi.y; ++y) {
      const std::span<const std::uint64_t> from = clear.row(y, z);
      const std::span<std::uint64_t> into = along.row(y, z);
      if (is_empty_row(from)) {
        continue;
      }
      for (std::size_t word = 0; word < into.size(); ++word) {
        into[word] = ~std::uint64_t{0};
        for (const std::int32_t step : steps) {
          into[word] &= shifted_word(from, word, step);
        }
      }
    }
  }
  return along;
}

// Row by row of the body, for 64 cells of the map at a time.
VANTAGE_INLINE VoxelGrid<std::uint8_t> cells_for_body(const OccupancyMap& map, const VoxelBox& box,
                                                      const std::vector<VoxelIndex>& touched) {
  VoxelGrid<std::uint8_t> grid(box);
  if (box.empty()) {
    return grid;
  }
  const CellRows clear = clear_rows(map, Brick::over(box.grown(reach_of(touched))));
  CellRows fits = clear;
  for (const auto& [steps, rows] : rows_of_body(touched)) {
    const CellRows along = clear_along(clear, steps);
    for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) {
      for (std::int32_t y = box.lo.y; y < box.hi.y; ++y) {
        const std::span<std::uint64_t> into = fits.row(y, z);
        if (is_empty_row(into)) {  // most rows where little of the box is known
          continue;
        }
        for (const auto& [step_y, step_z] : rows) {
          const std::span<const std::uint64_t> row = along.row(y + step_y, z + step_z);
          std::uint64_t left = 0;
          for (std::size_t word = 0; word < into.size(); ++word) {
            into[word] &= row[word];
            left |= into[word];
          }
          if (left == 0) {
            break;
          }
        }
      }
    }
  }
  for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) {
    for (std::int32_t y = box.lo.y; y < box.hi.y; ++y) {
      if (!is_empty_row(fits.row(y, z))) {
        const std::span<std::uint8_t> values(&grid[{box.lo.x, y, z}], static_cast<std::size_t>(box.extent().x));
        for (std::int32_t x = box.lo.x; x < box.hi.x; ++x) {
          values[static_cast<std::size_t>(x - box.lo.x)] = fits.contains({x, y, z}) ? 1 : 0;
        }
      }
    }
  }
  return grid;
}

}  // namespace vantage::detail
