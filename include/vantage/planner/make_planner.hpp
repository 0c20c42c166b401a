// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>
#include <vantage/compiler.hpp>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/planner/planner_setup.hpp>
#include <vantage/settings/setting.hpp>
#include <vector>

namespace VANTAGE_EXPORT vantage {

/// Makes a planner by name. To set all options, construct the class of the planner instead. Throws
/// std::invalid_argument if the planner or a setting does not exist (the message lists those that exist), or if a
/// value is invalid.
[[nodiscard]] std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                               const Settings& settings = {});

/// The settings of a planner, in the order in which they are applied. Throws std::invalid_argument if the planner
/// does not exist.
[[nodiscard]] std::vector<Setting> planner_settings(std::string_view name);

/// The names that `make_planner` accepts.
[[nodiscard]] const std::vector<std::string_view>& planner_names();

}  // namespace vantage

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/make_planner.ipp>
#endif
