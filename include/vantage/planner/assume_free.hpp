// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>
#include <vantage/map/occupancy_map.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>

namespace VANTAGE_EXPORT vantage {

/// Declares the space free that a robot needs for its first plan, as whoever starts it there vouches for: the still
/// unknown cells that its body touches at `pose`, and those within `clearance_m` of the sensor. Throws
/// std::invalid_argument unless `clearance_m` is in [0, 5].
///
///     assume_free(map, *platform, pose, start_clearance_m(*platform, sensor));
void assume_free(OccupancyMap& map, const Platform& platform, const Pose& pose, double clearance_m = 0.0);

/// How far around the sensor space must be free for a robot to get away from where it starts, metres: a sensor of a
/// narrow view does not see what lies right beside the body, so the body has to move blindly until the space it needs
/// fits into the view. 0 for a sensor that sees all around from its shortest range 0 on.
[[nodiscard]] double start_clearance_m(const Platform& platform, const RangeSensor& sensor);

}  // namespace vantage
