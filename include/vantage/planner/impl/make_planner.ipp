// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/nearest_frontier_planner.hpp>
#include <vantage/planner/next_best_view_explorer.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/planner/object_planner.hpp>
#include <vantage/planner/tour_planner.hpp>

#include <vantage/planner/impl/planner_tables.hpp>
#include <vantage/view/impl/frontier_survey_settings.hpp>

namespace vantage {
namespace detail {

// A planner of a class, whose options are read from their table.
template <class Planner, class Options>
std::unique_ptr<ExplorationPlanner> made(std::string_view name, const SettingTable<Options>& table,
                                         const PlannerSetup& setup, const Settings& settings) {
  Options options;
  table.read(name, settings, options);
  return std::make_unique<Planner>(setup, options);
}

// The settings of all planners behind the name "next-best-view".
inline std::vector<Setting> all_next_best_view_settings() {
  std::vector<Setting> all = object_planner_settings().list();
  std::vector<Setting> of_the_paper = next_best_view_settings().list();
  std::erase_if(of_the_paper, [](const Setting& one) { return object_planner_settings().has(one.name); });
  std::vector<Setting> without_object = next_best_view_explorer_settings().list();
  std::erase_if(without_object, [](const Setting& one) { return next_best_view_settings().has(one.name); });
  all.insert(all.end(), of_the_paper.begin(), of_the_paper.end());
  all.insert(all.end(), without_object.begin(), without_object.end());
  return all;
}

// As `made`, one of the planners behind the name "next-best-view". The settings of the others may have their
// defaults.
template <class Planner, class Options>
std::unique_ptr<ExplorationPlanner> made_one_of(std::string_view name, const SettingTable<Options>& table,
                                                const PlannerSetup& setup, Settings settings) {
  for (const Setting& setting : all_next_best_view_settings()) {
    const auto given = settings.find(setting.name);
    if (given != settings.end() && !table.has(setting.name) && !given->second.empty() &&
        given->second == setting.default_value) {
      settings.erase(given);
    }
  }
  return made<Planner>(name, table, setup, settings);
}

// Without an object, NextBestViewExplorer; with one, ObjectPlanner, or NextBestViewPlanner if a setting of the
// paper's utility is given.
inline std::unique_ptr<ExplorationPlanner> made_next_best_view(const PlannerSetup& setup, const Settings& settings) {
  const auto gives = [&](std::string_view name) { return settings.find(name) != settings.end(); };
  if (!gives("object")) {
    return made_one_of<NextBestViewExplorer>("next-best-view without an object", next_best_view_explorer_settings(),
                                             setup, settings);
  }
  const auto method = settings.find("method");
  if ((method != settings.end() && method->second != "default") || gives("gain") || gives("min_unknown_cells") ||
      gives("min_overlap_cells")) {
    return made_one_of<NextBestViewPlanner>("next-best-view by the paper's utility", next_best_view_settings(), setup,
                                            settings);
  }
  return made_one_of<ObjectPlanner>("next-best-view of an object", object_planner_settings(), setup, settings);
}

struct Maker {
  std::string_view name;
  std::function<std::unique_ptr<ExplorationPlanner>(const PlannerSetup&, const Settings&)> make;
  std::vector<Setting> settings;
};

template <class Planner, class Options>
Maker maker(std::string_view name, const SettingTable<Options>& table) {
  return {name,
          [name, &table](const PlannerSetup& setup, const Settings& settings) {
            return made<Planner>(name, table, setup, settings);
          },
          table.list()};
}

inline const std::vector<Maker>& makers() {
  static const std::vector<Maker> all{
      maker<FrontierGainPlanner>("frontier-gain", detail::frontier_gain_settings()),
      maker<FrontierVoidPlanner>("frontier-void", detail::frontier_void_settings()),
      maker<HarmonicPlanner>("harmonic", detail::harmonic_settings()),
      maker<NearestFrontierPlanner>("nearest-frontier", detail::frontier_survey_settings()),
      {"next-best-view", made_next_best_view, all_next_best_view_settings()},
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
