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

/// Options by name, as `--set key=value` gives them.
using PlannerSettings = std::map<std::string, std::string, std::less<>>;

/// A setting of a planner, as `vantage list --settings PLANNER` prints it.
struct PlannerSetting {
  std::string name;           ///< key of PlannerSettings
  std::string default_value;  ///< as text; empty: none
  std::string unit;           ///< empty: none
  std::string meaning;        ///< one line
};

/// A planner by NAME, for hosts and experiments; those who tune one construct its class. Throws std::invalid_argument
/// if there is no such planner or no such setting (listing those there are), or a value does not fit.
[[nodiscard]] std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                               const PlannerSettings& settings = {});

/// The settings of a planner, in the order in which they take effect. Throws std::invalid_argument if there is no
/// such planner.
[[nodiscard]] std::vector<PlannerSetting> planner_settings(std::string_view name);

/// The names `make_planner` knows.
[[nodiscard]] const std::vector<std::string_view>& planner_names();

}  // namespace vantage
