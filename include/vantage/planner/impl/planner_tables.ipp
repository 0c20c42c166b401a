// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/planner/object_planner.hpp>
#include <vantage/planner/tour_planner.hpp>

#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/view/impl/frontier_survey_settings.hpp>
#include <vantage/view/impl/object_view_settings.hpp>

namespace vantage::detail {

VANTAGE_INLINE const SettingTable<FrontierGainOptions>& frontier_gain_settings() {
  using O = FrontierGainOptions;
  static const auto table =
      with_survey<O>("FrontierGainOptions", &O::survey)
          .number("hypotheses", "poses", "tried per plan", within(1, 1e6), &O::hypotheses)
          .number("cost_per_m", "1/m", "a view counts 1 / (1 + this * metres)", at_least(0), &O::cost_per_m);
  return table;
}

VANTAGE_INLINE const SettingTable<FrontierVoidOptions>& frontier_void_settings() {
  using O = FrontierVoidOptions;
  using S = FrontierVoidStrategy;
  static const auto table =
      with_survey<O>("FrontierVoidOptions", &O::survey)
          .mode<S>("mode", "what to make of the voids; later settings refine it",
                   {{"default", {}}, {"faithful", S::faithful()}, {"searching", S::searching()}}, &O::strategy)
          .number("views", "views", "valid views evaluated per plan (N)", within(1, 1e6), &O::strategy, &S::views)
          .number("min_score", "", "least fit of a cluster's ellipsoid", more_than(0), &O::clusters,
                  &VoidClusterOptions::min_score)
          .number("cost_per_m", "1/m", "a view counts 1 / (1 + this * metres)", at_least(0), &O::strategy,
                  &S::cost_per_m)
          .number("least_view_m3", "m^3", "a view that is expected to show less void does not count", at_least(0),
                  &O::strategy, &S::least_view_m3)
          .flag("beyond_voids", "continues with frontiers that border no void", &O::strategy, &S::beyond_voids);
  return table;
}

VANTAGE_INLINE const SettingTable<HarmonicOptions>& harmonic_settings() {
  using O = HarmonicOptions;
  using F = HarmonicFieldOptions;
  using S = HarmonicStrategy;
  static const auto table =
      with_survey<O>("HarmonicOptions", &O::survey)
          .mode<S>("mode", "what to make of the field; later settings refine it",
                   {{"default", {}}, {"faithful", S::faithful()}}, &O::strategy)
          .choice<FieldSolver>("solver", "how the field is solved",
                               {{"multigrid", FieldSolver::Multigrid}, {"gauss-seidel", FieldSolver::GaussSeidel}},
                               &O::field, &F::solver)
          .choice<NeumannScheme>("neumann", "what a closed face contributes; mirror needs gauss-seidel",
                                 {{"finite-volume", NeumannScheme::FiniteVolume}, {"mirror", NeumannScheme::Mirror}},
                                 &O::field, &F::neumann)
          .number("tolerance", "", "gauss-seidel: largest relative change of the last sweep", within(1e-15, 1),
                  &O::field, &F::tolerance)
          .number("detour_m", "m", "frontiers further than the nearest by more than this wait", at_least(0),
                  &O::strategy, &S::detour_m)
          .flag("look_early", "looks from the first place of the path that sees the frontier", &O::strategy,
                &S::look_early)
          .number("look_again_m3", "m^3",
                  "looks again from the same place while a view is expected to show that much", at_least(0),
                  &O::strategy, &S::look_again_m3)
          .flag("shortest_way", "takes the shortest path, not the streamline", &O::strategy, &S::shortest_way)
          .limit("HarmonicFieldOptions::uniform_source", at_least(0), &O::field, &F::uniform_source)
          .limit("HarmonicFieldOptions::max_sweeps", within(1, 1e7), &O::field, &F::max_sweeps);
  return table;
}

VANTAGE_INLINE const SettingTable<NextBestViewExplorerOptions>& next_best_view_explorer_settings() {
  using O = NextBestViewExplorerOptions;
  static const auto table =
      with_survey<O>("NextBestViewExplorerOptions", &O::survey)
          .number("hypotheses", "views", "without an object: scored per plan", within(1, 1e6), &O::hypotheses);
  return table;
}

VANTAGE_INLINE const SettingTable<ObjectPlannerOptions>& object_planner_settings() {
  using O = ObjectPlannerOptions;
  static const auto table =
      with_object_views<O>("ObjectPlannerOptions", &O::candidates)
          .number("min_new_share", "", "a view that shows less than this share of the surface seen does not count",
                  {0.0, 1.0, true, false}, &O::min_new_share)
          .number("view_price", "", "what a view costs beside its path, in radii of the first shell",
                  {0.0, 1e6, false}, &O::view_price);
  return table;
}

VANTAGE_INLINE const SettingTable<NextBestViewOptions>& next_best_view_settings() {
  using O = NextBestViewOptions;
  static const auto table = [] {
    std::vector<std::pair<std::string_view, RayGainMaker>> gains{{"unknown-cells", nullptr}};
    for (const std::string_view name : ray_gain_names()) {
      gains.emplace_back(name, ray_gain_named(name));
    }
    auto all = with_object_views<O>("NextBestViewOptions", &O::candidates);
    all.choice<VisibilityMethod>("method", "how views are evaluated",
                                 {{"default", VisibilityMethod::Exact},
                                  {"uniform", VisibilityMethod::Uniform},
                                  {"hierarchical", VisibilityMethod::Hierarchical}},
                                 &O::method)
        .choice<RayGainMaker>("gain", "what new surface is worth", gains, &O::gain)
        .number("min_overlap_cells", "cells", "occupied cells of the object a view must see (h_oc)", at_least(0),
                &O::min_overlap_cells)
        .number("min_unknown_cells", "cells", "unknown cells of the object a view must see", at_least(1),
                &O::min_unknown_cells);
    return add_patience(all, &O::patience);
  }();
  return table;
}

VANTAGE_INLINE const SettingTable<TourOptions>& tour_settings() {
  using O = TourOptions;
  static const auto table = with_survey<O>("TourOptions", &O::survey)
                                .choice<TourCost>("cost", "what a tour is to save: seconds or metres",
                                                  {{"time", TourCost::Time}, {"path", TourCost::Path}}, &O::cost);
  return table;
}

}  // namespace vantage::detail
