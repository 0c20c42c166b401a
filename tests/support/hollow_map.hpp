// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::test {

/// A map with much free space, so that rays reach far: a box of free cells that holds boxes and single cells of other
/// states.
inline OccupancyMap hollow_map(std::mt19937& engine, double resolution_m) {
  OccupancyMap map({.resolution_m = resolution_m});
  std::uniform_int_distribution<std::int32_t> extent(10, 90);
  std::uniform_int_distribution<std::int32_t> coordinate(-50, 50);
  map.set_log_odds(
      VoxelBox{{-extent(engine), -extent(engine), -extent(engine)}, {extent(engine), extent(engine), extent(engine)}},
      -2.0);
  const int things = extent(engine);
  for (int i = 0; i < things; ++i) {
    const VoxelIndex cell{coordinate(engine), coordinate(engine), coordinate(engine)};
    if (i % 2 == 0) {
      const std::int32_t edge = extent(engine) / 8;
      map.set_log_odds(VoxelBox{cell, cell + VoxelIndex{edge, edge, edge}}, i % 8 != 0 ? 3.0 : -1.0);
    } else {
      map.set(cell, static_cast<Occupancy>(i % 3));
    }
  }
  return map;
}

}  // namespace vantage::test
