// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
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

#include "planner/planner_tables.hpp"

namespace vantage {
namespace {

// Makes a planner of a class from settings and the table of its options.
template <class Planner, class Options>
std::unique_ptr<ExplorationPlanner> made(const PlannerSetup& setup, std::string_view name,
                                         const PlannerSettings& settings,
                                         const detail::SettingTable<Options>& table) {
  Options options;
  table.read(name, settings, options);
  return std::make_unique<Planner>(setup, options);
}

// With an object, ObjectPlanner, unless a setting of the paper's utility is given; else NextBestViewPlanner.
std::unique_ptr<ExplorationPlanner> made_next_best_view(const PlannerSetup& setup, const PlannerSettings& settings) {
  NextBestViewOptions options;
  detail::next_best_view_settings().read("next-best-view", settings, options);
  detail::next_best_view_settings().validate(options);
  if (const double furthest_m = *std::max_element(options.radii_m.begin(), options.radii_m.end()); furthest_m > 0.0) {
    options.aimed.min_distance_m = furthest_m / 3.0;
    options.aimed.max_distance_m = furthest_m;
  }
  constexpr std::array<std::string_view, 4> kOfThePaper{"gain", "choice", "min_unknown_cells", "min_overlap_cells"};
  const bool as_the_paper = options.method != VisibilityMethod::Exact ||
                            std::any_of(kOfThePaper.begin(), kOfThePaper.end(),
                                        [&](std::string_view name) { return settings.find(name) != settings.end(); });
  if (!options.object || as_the_paper) {
    return std::make_unique<NextBestViewPlanner>(setup, options);
  }
  return std::make_unique<ObjectPlanner>(setup, ObjectPlannerOptions{.object = *options.object,
                                                                     .radii_m = options.radii_m,
                                                                     .subdivisions = options.subdivisions,
                                                                     .random_candidates = options.random_candidates,
                                                                     .aimed = options.aimed});
}

struct Maker {
  std::string_view name;
  std::unique_ptr<ExplorationPlanner> (*make)(const PlannerSetup&, const PlannerSettings&);
  std::vector<PlannerSetting> (*list)();
};

const std::vector<Maker>& makers() {
  static const std::vector<Maker> all{
      {"frontier-gain",
       [](const PlannerSetup& setup, const PlannerSettings& settings) {
         return made<FrontierGainPlanner>(setup, "frontier-gain", settings, detail::frontier_gain_settings());
       },
       [] { return detail::frontier_gain_settings().list(); }},
      {"frontier-void",
       [](const PlannerSetup& setup, const PlannerSettings& settings) {
         return made<FrontierVoidPlanner>(setup, "frontier-void", settings, detail::frontier_void_settings());
       },
       [] { return detail::frontier_void_settings().list(); }},
      {"harmonic",
       [](const PlannerSetup& setup, const PlannerSettings& settings) {
         return made<HarmonicPlanner>(setup, "harmonic", settings, detail::harmonic_settings());
       },
       [] { return detail::harmonic_settings().list(); }},
      {"nearest-frontier",
       [](const PlannerSetup& setup, const PlannerSettings& settings) {
         return made<NearestFrontierPlanner>(setup, "nearest-frontier", settings, detail::frontier_survey_settings());
       },
       [] { return detail::frontier_survey_settings().list(); }},
      {"next-best-view",
       [](const PlannerSetup& setup, const PlannerSettings& settings) {
         return made_next_best_view(setup, settings);
       },
       [] { return detail::next_best_view_settings().list(); }},
      {"tour",
       [](const PlannerSetup& setup, const PlannerSettings& settings) {
         return made<TourPlanner>(setup, "tour", settings, detail::tour_settings());
       },
       [] { return detail::tour_settings().list(); }},
  };
  return all;
}

const Maker& maker_of(std::string_view name) {
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

}  // namespace

std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                 const PlannerSettings& settings) {
  return maker_of(name).make(setup, settings);
}

std::vector<PlannerSetting> planner_settings(std::string_view name) { return maker_of(name).list(); }

const std::vector<std::string_view>& planner_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Maker& maker : makers()) {
      all.push_back(maker.name);
    }
    return all;
  }();
  return names;
}

}  // namespace vantage
