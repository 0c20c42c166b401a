// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/raytrace/range_sensor.hpp>
#include <vantage/robot/platform.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// What every planner needs to know of the robot.
struct PlannerSetup {
  RangeSensor sensor;                        ///< what it sees
  std::shared_ptr<const Platform> platform;  ///< what carries it; never null
  std::uint64_t seed = 1;                    ///< of everything random
  int threads = 1;                           ///< > 0; never changes the plan
};

/// Options by name, as `--set key=value` gives them.
using PlannerSettings = std::map<std::string, std::string, std::less<>>;

/// A planner by NAME, for hosts and experiments; those who tune one construct its class. Throws std::invalid_argument
/// if there is no such planner or no such setting (listing those there are), or a value does not fit.
[[nodiscard]] std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                               const PlannerSettings& settings = {});

/// The names `make_planner` knows.
[[nodiscard]] const std::vector<std::string_view>& planner_names();

}  // namespace vantage
