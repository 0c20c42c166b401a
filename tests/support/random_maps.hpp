// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>

namespace vantage::test {

/// A scan with `rays` returns and missing returns around a random pose within 3 m of the origin.
inline Scan random_scan(std::mt19937& engine, std::size_t rays, double max_range_m = 4.0) {
  std::uniform_real_distribution<double> metre(-3.0, 3.0);
  Scan scan;
  scan.world_from_sensor =
      pose_looking({metre(engine), metre(engine), metre(engine)}, metre(engine), 0.3 * metre(engine));
  scan.max_range_m = max_range_m;
  for (std::size_t i = 0; i < rays; ++i) {
    const Eigen::Vector3d point(metre(engine), metre(engine), metre(engine));
    (i % 5 == 0 ? scan.no_return : scan.points).push_back(point.cast<float>());
  }
  return scan;
}

/// A map of scans, boxes of one state (which an octree prunes) and single cells, on both sides of the origin.
inline OccupancyMap random_map(std::mt19937& engine, double resolution_m = 0.1) {
  OccupancyMap map({.resolution_m = resolution_m});
  for (int i = 0; i < 3; ++i) {
    map.insert(random_scan(engine, 60));
  }
  std::uniform_int_distribution<std::int32_t> coordinate(-40, 40);
  std::uniform_int_distribution<std::int32_t> extent(1, 14);
  std::uniform_real_distribution<double> log_odds(-2.0, 3.5);
  for (int box = 0; box < 4; ++box) {
    const VoxelIndex lo{coordinate(engine), coordinate(engine), coordinate(engine)};
    const std::int32_t edge = extent(engine);
    map.set_log_odds(VoxelBox{lo, lo + VoxelIndex{edge, edge, edge}}, log_odds(engine));
  }
  for (int i = 0; i < 40; ++i) {
    map.set({coordinate(engine), coordinate(engine), coordinate(engine)}, static_cast<Occupancy>(i % 3));
  }
  return map;
}

}  // namespace vantage::test
