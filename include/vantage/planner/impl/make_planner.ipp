// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/nearest_frontier_planner.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/planner/object_planner.hpp>
#include <vantage/planner/tour_planner.hpp>

#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/view/impl/frontier_survey_settings.hpp>

namespace vantage {
namespace detail {

// Without an object, NextBestViewExplorer; with one, ObjectPlanner, or NextBestViewPlanner if a setting of the
// paper's utility is given.
inline std::unique_ptr<ExplorationPlanner> made_next_best_view(const PlannerSetup& setup, const Settings& settings) {
  detail::NextBestViewChoices choices;
  detail::next_best_view_settings().read("next-best-view", settings, choices);
  detail::next_best_view_settings().validate(choices);
  if (settings.find("object") == settings.end()) {
    return std::make_unique<NextBestViewExplorer>(setup, choices.exploration);
  }
  NextBestViewOptions& options = choices.object;
  ObjectViewOptions& candidates = options.candidates;
  candidates.aimed.max_distance_m = *std::max_element(candidates.radii_m.begin(), candidates.radii_m.end());
  candidates.aimed.min_distance_m = candidates.aimed.max_distance_m / 3.0;
  options.patience = choices.exploration.survey.patience;
  constexpr std::array<std::string_view, 3> kOfThePaper{"gain", "min_unknown_cells", "min_overlap_cells"};
  const bool as_the_paper = options.method != VisibilityMethod::Exact ||
                            std::any_of(kOfThePaper.begin(), kOfThePaper.end(),
                                        [&](std::string_view name) { return settings.find(name) != settings.end(); });
  if (as_the_paper) {
    return std::make_unique<NextBestViewPlanner>(setup, options);
  }
  return std::make_unique<ObjectPlanner>(setup, ObjectPlannerOptions{.candidates = candidates});
}

struct Maker {
  std::string_view name;
  std::function<std::unique_ptr<ExplorationPlanner>(const PlannerSetup&, const Settings&)> make;
  std::vector<Setting> settings;
};

// The maker of a planner of a class, from the table of its options.
template <class Planner, class Options>
Maker maker(std::string_view name, const detail::SettingTable<Options>& table) {
  return {name,
          [name, &table](const PlannerSetup& setup, const Settings& settings) {
            Options options;
            table.read(name, settings, options);
            return std::make_unique<Planner>(setup, options);
          },
          table.list()};
}

inline const std::vector<Maker>& makers() {
  static const std::vector<Maker> all{
      maker<FrontierGainPlanner>("frontier-gain", detail::frontier_gain_settings()),
      maker<FrontierVoidPlanner>("frontier-void", detail::frontier_void_settings()),
      maker<HarmonicPlanner>("harmonic", detail::harmonic_settings()),
      maker<NearestFrontierPlanner>("nearest-frontier", detail::frontier_survey_settings()),
      {"next-best-view", made_next_best_view, detail::next_best_view_settings().list()},
      maker<TourPlanner>("tour", detail::tour_settings()),
  };
  return all;
}

inline const Maker& maker_of(std::string_view name) {
  const auto found =
      std::find_if(makers().begin(), makers().end(), [&](const Maker& maker) { return maker.name == name; });
  if (found == makers().end()) {
    std::string names;
    for (const std::string_view known : planner_names()) {
      names += (names.empty() ? "" : ", ") + std::string(known);
    }
    throw std::invalid_argument("there is no planner '" + std::string(name) + "'; there are: " + names);
  }
  return *found;
}

}  // namespace detail

VANTAGE_INLINE std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                                const Settings& settings) {
  return detail::maker_of(name).make(setup, settings);
}

VANTAGE_INLINE std::vector<Setting> planner_settings(std::string_view name) {
  return detail::maker_of(name).settings;
}

VANTAGE_INLINE const std::vector<std::string_view>& planner_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const detail::Maker& maker : detail::makers()) {
      all.push_back(maker.name);
    }
    return all;
  }();
  return names;
}

}  // namespace vantage
