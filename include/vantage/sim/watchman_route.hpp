// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/truth.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Limits of the search of watchman_route.
struct WatchmanOptions {
  /// Largest number of witnesses, in [1, 12]. Memory and time double with each: 4 bytes times 2^witnesses per
  /// reachable cell, and up to 800 bytes for the ways to the next cells.
  std::size_t max_witnesses = 8;
  int threads = 1;  ///< threads that test lines of sight, > 0
  /// Called often, from several threads at once. Once it returns true, the search ends with the route so far.
  std::function<bool()> stop = {};
};

/// The optimal route with full knowledge of the world, or a lower bound on it.
struct WatchmanRoute {
  double length_m = 0.0;              ///< metres; no route over the steps below that sees everything is shorter
  bool sees_all = false;              ///< whether this route sees everything: then it is the optimal one
  double seen = 0.0;                  ///< share of the observable cells that it sees, in [0, 1]
  std::vector<VoxelIndex> cells;      ///< the route, from the start
  std::vector<VoxelIndex> witnesses;  ///< the cells that the route was made to see
};

/// Finds the shortest route from `start` that sees every observable cell (Truth::observable), given full knowledge
/// of the world: the watchman route problem. Its length is a lower bound for planners, up to the 5 % below.
///
/// The route is the shortest one that sees a few witness cells. While it misses some cell, the one that is hardest
/// to get into sight becomes a further witness. So the route is never longer than the optimal one, and once it
/// sees everything it is the optimal one.
///
/// The sensor moves between reachable cells in 98 directions (up to two cells along each axis, corners cut), which
/// is at most 5 % longer than the straight line. It looks in all directions all along. It sees a cell if one of 27
/// points of the cell (centre, faces, edges, corners) is in sight.
///
/// Throws std::invalid_argument with the option at fault, or if the platform cannot be at `start`. (Chin & Ntafos
/// 1986)
[[nodiscard]] WatchmanRoute watchman_route(const Truth& truth, const Platform& platform, const RangeSensor& sensor,
                                           const Pose& start, const WatchmanOptions& options = {});

}  // namespace vantage
