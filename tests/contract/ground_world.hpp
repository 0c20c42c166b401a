// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vantage/map/height_band.hpp>

#include "contract/changing_world.hpp"

namespace vantage::testing {

/// The heights that matter for a robot that drives on the floor of a building, whose upper face is at z = 1 cell. It
/// drives over what is one cell high, and under what hangs in the uppermost cells, as the lintels of the doors do.
[[nodiscard]] inline HeightBandOptions band_above_floor(double cell_m) {
  return {.min_height_m = 1.75 * cell_m,
          .max_height_m = 6.0 * cell_m,
          .sensor_height_m = 3.5 * cell_m,
          .step_height_m = 1.25 * cell_m};
}

/// Whether the floor is missing in this column.
[[nodiscard]] inline bool is_pit(const ChangingWorld& world, const VoxelIndex& column) {
  return world.solid.value_or({column.x, column.y, 0}, 1) == 0;
}

/// Digs two pits 2 m deep into the floor of a building, at least two cells away from the start.
inline void dig_pits(ChangingWorld& world, std::uint32_t seed) {
  const auto deep = static_cast<std::int32_t>(std::lround(2.0 / world.frame.size_m));
  VoxelBox box = world.solid.box();
  box.lo.z = -deep;
  VoxelGrid<std::uint8_t> solid(box, 1);
  for_each_cell(world.solid.box(), [&](const VoxelIndex& cell) { solid[cell] = world.solid[cell]; });
  WholeNumbers draw(seed);
  for (int pits = 0; pits < 2;) {
    const VoxelIndex lo{draw(1, box.hi.x - 3), draw(1, box.hi.y - 3), 1 - deep};
    const VoxelBox pit{lo, {lo.x + draw(2, 4), lo.y + draw(2, 4), 1}};
    if (VoxelBox{pit.lo, {pit.hi.x, pit.hi.y, world.start.z + 1}}.grown(2).contains(world.start)) {
      continue;
    }
    for_each_cell(pit, [&](const VoxelIndex& cell) {
      if (world.solid.value_or({cell.x, cell.y, 1}, 1) == 0) {  // not below walls
        solid[cell] = 0;
      }
    });
    ++pits;
  }
  world.solid = solid;
}

}  // namespace vantage::testing
