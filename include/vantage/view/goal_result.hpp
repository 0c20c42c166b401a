// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vantage/compiler.hpp>

namespace VANTAGE_EXPORT vantage {

/// How following a plan ended. Reported by the host.
enum class GoalResult : std::uint8_t {
  Reached,    ///< the sensor is as close to the goal as the controller brings it, and has scanned there
  Failed,     ///< the controller cannot reach the goal
  Preempted,  ///< the host cancelled the goal; says nothing about whether it can be reached
};

}  // namespace vantage
