// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/planner_setup.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Settings by name, as `--set key=value` gives them.
using PlannerSettings = std::map<std::string, std::string, std::less<>>;

/// A setting of a planner, as `vantage list --settings PLANNER` prints it.
struct PlannerSetting {
  std::string name;           ///< key in PlannerSettings
  std::string default_value;  ///< as text; empty if there is none
  std::string unit;           ///< empty if there is none
  std::string meaning;        ///< one line
};

/// Makes a planner by name. To set all options, construct the class of the planner instead. Throws
/// std::invalid_argument if the planner or a setting does not exist (the message lists those that exist), or if a
/// value is invalid.
[[nodiscard]] std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                               const PlannerSettings& settings = {});

/// The settings of a planner, in the order in which they are applied. Throws std::invalid_argument if the planner
/// does not exist. such planner.
[[nodiscard]] std::vector<PlannerSetting> planner_settings(std::string_view name);

/// The names that `make_planner` accepts.
[[nodiscard]] const std::vector<std::string_view>& planner_names();

}  // namespace vantage
