// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/planner/tour_planner.hpp>

#include "settings/setting_table.hpp"

namespace vantage::detail {

/// Options behind the name "next-best-view".
struct NextBestViewChoices {
  NextBestViewOptions object = {};               ///< with an object
  NextBestViewExplorerOptions exploration = {};  ///< without one
};

/// One table per options struct. `make_planner` reads it, `planner_settings` lists it and most constructors validate
/// with it.
[[nodiscard]] const SettingTable<FrontierSurveyOptions>& frontier_survey_settings();
[[nodiscard]] const SettingTable<FrontierGainOptions>& frontier_gain_settings();
[[nodiscard]] const SettingTable<FrontierVoidOptions>& frontier_void_settings();
[[nodiscard]] const SettingTable<HarmonicOptions>& harmonic_settings();
[[nodiscard]] const SettingTable<NextBestViewChoices>& next_best_view_settings();
[[nodiscard]] const SettingTable<TourOptions>& tour_settings();

}  // namespace vantage::detail
