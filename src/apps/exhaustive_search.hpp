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

/// The poses of the drawn postures that the map admits, every n-th of them so that there are so many at most: as good
/// as everywhere.
[[nodiscard]] std::vector<Pose> exhaustive_poses(const Arm& arm, const OccupancyMap& map,
                                                 std::size_t most_poses = 8000);

/// Prints what all these poses would see of the voids that are left: void cells in which a ray of the sensor ends and
/// whose centre is in plain sight, so that nothing counts that shows through a worn surface only.
void print_exhaustive(std::ostream& out, const Arm& arm, const RangeSensor& sensor, const OccupancyMap& map);

/// How few views could do, for one who knows the truth.
struct ViewsNeeded {
  std::size_t poses_now = 0;      ///< that the arm can take in the map
  std::size_t poses = 0;          ///< among which views are chosen: these, and those that the truth admits
  std::size_t to_see = 0;         ///< void cells of the map that some of the poses it can take would make known
  std::vector<std::size_t> left;  ///< of these, after each view that a greedy choice takes
  double at_least = 0.0;          ///< no choice of fewer views sees them all (fewest_views_bound)
  /// The same even if every view made known one cell more all around what it does.
  double at_least_if_more_is_seen = 0.0;
};

/// Among so many poses that the map admits and as many that the truth does (`exhaustive_poses`). What a view would
/// make known is measured in the scene, by rays half a cell apart at the sensor's range. The same for any number of
/// threads.
[[nodiscard]] ViewsNeeded views_needed(const Arm& arm, const RangeSensor& sensor, const OccupancyMap& map,
                                       const OccupancyMap& truth, const TriangleScene& scene, std::size_t most_poses,
                                       int threads);

/// Prints it; `cell_m` is the edge of a cell.
void print_views_needed(std::ostream& out, const ViewsNeeded& needed, double cell_m);

}  // namespace vantage::apps
