// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>

namespace vantage::detail {

/// Whether the sensor has what lies at the end of a line in its field of view if the platform turns it there as well
/// as it can. `from_m`: the start of the line, metres, world; `line_m`: the line, world. `off_axis`: the factor by
/// which the end counts as further away from the optical axis than it is; below 1, the edge of the field of view
/// counts, whichever way rounding goes.
inline bool can_face(const Platform& platform, const RangeSensor& sensor, const Eigen::Vector3d& from_m,
                     const Eigen::Vector3d& line_m, double off_axis = 1.0) {
  if (platform.can_tilt()) {
    return true;
  }
  const Eigen::Vector3d end = platform.facing(from_m, line_m).linear().transpose() * line_m;
  return sensor.in_view({off_axis * end.x(), off_axis * end.y(), end.z()});
}

}  // namespace vantage::detail
