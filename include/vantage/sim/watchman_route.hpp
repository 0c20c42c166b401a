// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vantage/compiler.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/sim/truth.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// How a watchman_route is sought.
struct WatchmanOptions {
  /// Cells that the route is drawn through sight of, one by one, at most, in [1, 12]. Memory and time double with
  /// every one: 4 bytes times 2^k for each cell that can be reached.
  std::size_t max_witnesses = 8;
  int threads = 1;  ///< for lines of sight, > 0
};

/// A way through a world that is known, and what it proves.
struct WatchmanRoute {
  double length_m = 0.0;              ///< metres; no route that sees everything is shorter
  bool sees_all = false;              ///< it does itself: so it is the shortest
  double seen = 0.0;                  ///< share of the observable cells that it sees
  std::vector<VoxelIndex> cells;      ///< where it goes, from the start on
  std::vector<VoxelIndex> witnesses;  ///< the cells to see which takes that long
};

/// The shortest route of one who knows the world, from `start` to sight of every observable cell (Truth::observable):
/// the watchman route problem (Chin & Ntafos 1986), and the measure of a planner that does not know it.
///
/// The route is the shortest one that sees a few witnesses, to which the one hardest to come into sight of is added
/// until the route sees everything else, too. So it is never longer than the shortest route that sees everything,
/// and once it does, it is that route. The sensor goes from cell to cell of those that it can be brought to, in 98
/// directions (up to two cells along every axis, corners cut), which is at most 5 % further than the straight line,
/// and looks everywhere at once, all along. It sees a cell if one of 27 points of it is in sight, its middle and
/// points of its faces, edges and corners: a ray of a real sensor need not hit the middle.
///
/// Throws std::invalid_argument naming the option at fault, or if the platform cannot be at `start`.
[[nodiscard]] WatchmanRoute watchman_route(const Truth& truth, const Platform& platform, const RangeSensor& sensor,
                                           const Pose& start, const WatchmanOptions& options = {});

}  // namespace vantage
