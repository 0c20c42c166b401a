// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/settings/impl/setting_table.hpp>

namespace vantage {
struct FrontierGainOptions;
struct FrontierVoidOptions;
struct HarmonicOptions;
struct NextBestViewExplorerOptions;
struct NextBestViewOptions;
struct ObjectPlannerOptions;
struct TourOptions;
}  // namespace vantage

namespace vantage::detail {

/// One table per options struct. `make_planner` reads it, `planner_settings` lists it and constructors validate with
/// it.
[[nodiscard]] const SettingTable<FrontierGainOptions>& frontier_gain_settings();
[[nodiscard]] const SettingTable<FrontierVoidOptions>& frontier_void_settings();
[[nodiscard]] const SettingTable<HarmonicOptions>& harmonic_settings();
[[nodiscard]] const SettingTable<NextBestViewExplorerOptions>& next_best_view_explorer_settings();
[[nodiscard]] const SettingTable<NextBestViewOptions>& next_best_view_settings();
[[nodiscard]] const SettingTable<ObjectPlannerOptions>& object_planner_settings();
[[nodiscard]] const SettingTable<TourOptions>& tour_settings();

}  // namespace vantage::detail

#if defined(VANTAGE_HEADER_ONLY)
#include <vantage/planner/impl/planner_tables.ipp>
#endif
