// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iosfwd>
#include <vantage/arm/arm.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/sim/triangle_scene.hpp>
#include <vector>

namespace vantage::apps {

/// At most this many poses of the drawn postures that the map admits, every n-th of them.
[[nodiscard]] std::vector<Pose> exhaustive_poses(const Arm& arm, const OccupancyMap& map,
                                                 std::size_t most_poses = 8000);

/// Prints what all these poses would see of the remaining voids: void cells in which a ray of the sensor ends and
/// whose centre is in plain sight. What only shows through a worn surface does not count.
void print_exhaustive(std::ostream& out, const Arm& arm, const RangeSensor& sensor, const OccupancyMap& map);

/// How many views are needed with full knowledge of the scene.
struct ViewsNeeded {
  std::size_t poses_now = 0;      ///< poses that the arm can take in the map
  std::size_t poses = 0;          ///< candidate poses: these and those that the true scene admits
  std::size_t to_see = 0;         ///< void cells of the map that some pose of the first kind would make known
  std::vector<std::size_t> left;  ///< of these, the cells left after each view of the greedy set cover
  double at_least = 0.0;          ///< lower bound on the number of views (fewest_views_bound)
  /// Lower bound on the number of views if every view also made known the neighbours of what it does.
  double at_least_if_more_is_seen = 0.0;
};

/// Computes this among at most so many poses that the map admits and as many that the true scene admits
/// (`exhaustive_poses`). What a view makes known is measured in the scene, by rays half a cell apart at the range
/// of the sensor. The same for any number of threads.
[[nodiscard]] ViewsNeeded views_needed(const Arm& arm, const RangeSensor& sensor, const OccupancyMap& map,
                                       const OccupancyMap& truth, const TriangleScene& scene, std::size_t most_poses,
                                       int threads);

/// Prints the result; `cell_m` is the edge of a cell, metres.
void print_views_needed(std::ostream& out, const ViewsNeeded& needed, double cell_m);

}  // namespace vantage::apps
