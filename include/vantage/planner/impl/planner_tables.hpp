// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/planner/next_best_view_planner.hpp>

#include <vantage/settings/impl/setting_table.hpp>

namespace vantage {
struct FrontierGainOptions;
struct FrontierVoidOptions;
struct HarmonicOptions;
struct TourOptions;
}  // namespace vantage

namespace vantage::detail {

/// Options behind the name "next-best-view".
struct NextBestViewChoices {
  NextBestViewOptions object = {};               ///< with an object
  NextBestViewExplorerOptions exploration = {};  ///< without one
};

/// One table per options struct. `make_planner` reads it, `planner_settings` lists it and most constructors validate
/// with it.
[[nodiscard]] const SettingTable<FrontierGainOptions>& frontier_gain_settings();
[[nodiscard]] const SettingTable<FrontierVoidOptions>& frontier_void_settings();
[[nodiscard]] const SettingTable<HarmonicOptions>& harmonic_settings();
[[nodiscard]] const SettingTable<NextBestViewChoices>& next_best_view_settings();
[[nodiscard]] const SettingTable<TourOptions>& tour_settings();

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/planner_tables.ipp>
#endif
