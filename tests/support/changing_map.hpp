// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage {

/// Changes a map of 0.1 m around the origin: a cell, a box of free cells, or a scan.
inline void change_around_origin(OccupancyMap& map, std::mt19937& engine) {
  const auto coordinate = [&] { return static_cast<std::int32_t>(engine() % 40) - 12; };
  const VoxelIndex lo{coordinate(), coordinate(), coordinate()};
  switch (engine() % 7) {
    case 0:
      map.set(lo, Occupancy::Occupied);
      break;
    case 1:
      map.set(lo, Occupancy::Unknown);
      break;
    case 2:
      map.set_log_odds(lo, 0.85 - 3 * 0.4);  // contested, still free
      break;
    case 3: {
      Scan scan;
      scan.world_from_sensor = pose_looking(map.frame().centre_of(lo), 0.0);
      for (int i = 0; i < 30; ++i) {
        scan.points.emplace_back(0.1F * static_cast<float>(coordinate()), 0.1F * static_cast<float>(coordinate()),
                                 2.0F);
      }
      map.insert(scan);
      break;
    }
    default:
      map.set_log_odds(VoxelBox{lo, lo + VoxelIndex{9, 5, 7}}, -2.0);
  }
}

}  // namespace vantage
