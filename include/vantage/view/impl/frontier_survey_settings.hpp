// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vantage/settings/impl/setting_table.hpp>
#include <vantage/view/frontier_survey.hpp>

namespace vantage::detail {

/// Adds TriedViewsOptions::patience, at the end of `members`, to a table.
template <class Options, class... Members>
SettingTable<Options>& add_patience(SettingTable<Options>& table, Members... members) {
  return table.number("patience", "places", "from which a cell is looked at in vain before it is given up",
                      within(1, 100), members...);
}

/// The settings of how frontiers are surveyed, at the end of `members`.
template <class Options, class... Members>
SettingTable<Options> with_survey(std::string_view owner, Members... members) {
  using Survey = FrontierSurveyOptions;
  SettingTable<Options> table(owner);
  return add_patience(table, members..., &Survey::patience)
      .limit("FrontierSurveyOptions::sight_directions", at_least(6), members..., &Survey::sight_directions);
}

/// The table of a planner that has no other settings.
[[nodiscard]] inline const SettingTable<FrontierSurveyOptions>& frontier_survey_settings() {
  static const auto table = with_survey<FrontierSurveyOptions>("FrontierSurveyOptions");
  return table;
}

}  // namespace vantage::detail
