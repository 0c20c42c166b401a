// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/compiler.hpp>
#include <vantage/geometry/pose.hpp>

namespace VANTAGE_EXPORT vantage {

/// A sensor pose and its expected utility.
struct View {
  Pose pose = Pose::Identity();  ///< world_from_sensor
  double utility = 0.0;          ///< in the unit of the planner, e.g. cells or faces; 0 if nothing is expected
};

}  // namespace vantage
