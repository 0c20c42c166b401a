// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <stdexcept>
#include <vantage/planner/planner_setup.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {

VANTAGE_INLINE void PlannerSetup::validate() const {
  if (platform == nullptr) {
    throw std::invalid_argument("PlannerSetup::platform is null, must be a platform");
  }
  detail::require_option(threads >= 1, "PlannerSetup::threads", threads, ">= 1");
  detail::require_option(std::isfinite(goal_tolerance_m) && goal_tolerance_m >= 0.0, "PlannerSetup::goal_tolerance_m",
                         goal_tolerance_m, ">= 0");
  detail::require_option(std::isfinite(goal_tolerance_rad) && goal_tolerance_rad >= 0.0,
                         "PlannerSetup::goal_tolerance_rad", goal_tolerance_rad, ">= 0");
  if (motion) {
    motion->validate();
  }
  sensor.validate();
}

}  // namespace vantage
