// SPDX-License-Identifier: MIT
#include "planner/planner_tables.hpp"

#include <charconv>
#include <cmath>
#include <optional>

namespace vantage::detail {
namespace {

// Parses "x,y,..."; empty if the text has another form.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data();; ++at) {
    const auto [after, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc{} || !std::isfinite(numbers.back()) || (after != end && *after != ',')) {
      return {};
    }
    if (after == end) {
      return numbers;
    }
    at = after;
  }
}

// A table with the settings of the frontier survey.
template <class Options, class Survey>
SettingTable<Options> with_survey(std::string_view owner, Survey survey) {
  SettingTable<Options> table(owner);
  table.number(
      "patience", "places", "from which a cell is looked at in vain before it is given up",
      within(1, 100), [survey](Options & o) -> auto& { return survey(o).patience; });
  return table;
}

// Adds the setting "mode", which replaces the whole strategy.
template <class Options, class Strategy>
void add_mode(SettingTable<Options>& table, std::string_view meaning,
              std::vector<std::pair<std::string_view, Strategy>> modes) {
  std::string names;
  for (const auto& [name, strategy] : modes) {
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  table.text("mode", "", meaning, "one of " + names, [modes](Options& options, const std::string& text) {
    for (const auto& [name, strategy] : modes) {
      if (name == text) {
        options.strategy = strategy;
        return true;
      }
    }
    return false;
  });
}

}  // namespace

const SettingTable<FrontierSurveyOptions>& frontier_survey_settings() {
  static const auto table = with_survey<FrontierSurveyOptions>(
      "FrontierSurveyOptions", [](FrontierSurveyOptions& o) -> FrontierSurveyOptions& { return o; });
  return table;
}

const SettingTable<FrontierGainOptions>& frontier_gain_settings() {
  using O = FrontierGainOptions;
  static const auto table =
      with_survey<O>("FrontierGainOptions", [](O& o) -> FrontierSurveyOptions& { return o.survey; })
          .number(
              "hypotheses", "poses", "tried per plan", within(1, 1e6), [](O & o) -> auto& { return o.hypotheses; })
          .number(
              "aimed_share", "", "share of the hypotheses that look at some frontier", within(0, 1),
              [](O & o) -> auto& { return o.aimed_share; })
          .number(
              "cost_per_m", "cells/m", "what a metre costs, in frontier cells", at_least(0),
              [](O & o) -> auto& { return o.cost_per_m; });
  return table;
}

const SettingTable<FrontierVoidOptions>& frontier_void_settings() {
  using O = FrontierVoidOptions;
  static const auto table = [] {
    auto made = with_survey<O>("FrontierVoidOptions", [](O& o) -> FrontierSurveyOptions& { return o.survey; });
    add_mode<O, FrontierVoidStrategy>(made, "what to make of the voids; later settings refine it",
                                      {{"default", {}},
                                       {"faithful", FrontierVoidStrategy::faithful()},
                                       {"travelling", FrontierVoidStrategy::travelling()},
                                       {"searching", FrontierVoidStrategy::searching()}});
    made.number(
            "views", "views", "valid views evaluated per plan (N)", within(1, 1e6),
            [](O & o) -> auto& { return o.views; })
        .number(
            "min_score", "", "least fit of a cluster's ellipsoid", more_than(0),
            [](O & o) -> auto& { return o.clusters.min_score; })
        .number(
            "cost_per_m", "1/m", "a view counts 1 / (1 + this * metres)", at_least(0),
            [](O & o) -> auto& { return o.strategy.cost_per_m; })
        .number(
            "least_view_m3", "m^3", "a view that is expected to learn less of the voids is none", at_least(0),
            [](O & o) -> auto& { return o.strategy.least_view_m3; })
        .flag(
            "beyond_voids", "goes on to frontiers that border no void",
            [](O & o) -> auto& { return o.strategy.beyond_voids; });
    return made;
  }();
  return table;
}

const SettingTable<HarmonicOptions>& harmonic_settings() {
  using O = HarmonicOptions;
  static const auto table = [] {
    auto made = with_survey<O>("HarmonicOptions", [](O& o) -> FrontierSurveyOptions& { return o.survey; });
    add_mode<O, HarmonicStrategy>(made, "what to make of the field; later settings refine it",
                                  {{"default", {}}, {"faithful", HarmonicStrategy::faithful()}});
    made.choice(
            "solver", "how the field is solved",
            std::vector<std::pair<std::string_view, FieldSolver>>{{"multigrid", FieldSolver::Multigrid},
                                                                  {"gauss-seidel", FieldSolver::GaussSeidel}},
            [](O & o) -> auto& { return o.solver; })
        .choice(
            "neumann", "what a closed face contributes",
            std::vector<std::pair<std::string_view, NeumannScheme>>{{"finite-volume", NeumannScheme::FiniteVolume},
                                                                    {"mirror", NeumannScheme::Mirror}},
            [](O & o) -> auto& { return o.neumann; })
        .number(
            "tolerance", "", "gauss-seidel: largest relative change of the last sweep", within(1e-15, 1),
            [](O & o) -> auto& { return o.tolerance; })
        .number(
            "uniform_source", "", "added everywhere, so that every cell has a way down; 0: the paper's field",
            at_least(0), [](O & o) -> auto& { return o.uniform_source; })
        .number(
            "detour_m", "m", "boundaries further than the nearest by more than this wait", at_least(0),
            [](O & o) -> auto& { return o.strategy.detour_m; })
        .flag(
            "look_early", "looks from the first place on the way that sees the boundary",
            [](O & o) -> auto& { return o.strategy.look_early; })
        .number(
            "look_spacing_m", "m", "after so much of the way any boundary in sight is looked at", at_least(0),
            [](O & o) -> auto& { return o.strategy.look_spacing_m; })
        .number(
            "look_again_m3", "m^3", "looks again from where it is while a view teaches that much", at_least(0),
            [](O & o) -> auto& { return o.strategy.look_again_m3; })
        .flag(
            "shortest_way", "takes the shortest way, not the streamline",
            [](O & o) -> auto& { return o.strategy.shortest_way; });
    return made;
  }();
  return table;
}

// NOLINTNEXTLINE(readability-function-size): a table
const SettingTable<NextBestViewOptions>& next_best_view_settings() {
  using O = NextBestViewOptions;
  static const auto table = [] {
    auto made = with_survey<O>("NextBestViewOptions", [](O& o) -> FrontierSurveyOptions& { return o.survey; });
    std::vector<std::pair<std::string_view, RayGainMaker>> gains{{"unknown-cells", nullptr}};
    for (const std::string_view name : ray_gain_names()) {
      gains.emplace_back(name, ray_gain_named(name));
    }
    made.text("object", "m", "the box of the object, x0,y0,z0,x1,y1,z1; none: the whole map", "six numbers",
              [](O& options, const std::string& text) {
                const std::vector<double> c = numbers_in(text);
                if (c.size() == 6) {
                  options.object = Box{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
                }
                return c.size() == 6;
              })
        .text("radii_m", "m", "distances of the candidates from the middle of the object",
              "numbers, with commas between them",
              [](O& options, const std::string& text) {
                options.radii_m = numbers_in(text);
                return !options.radii_m.empty();
              })
        .number(
            "subdivisions", "", "candidates of a shell: 20 * 4^this; -1: none", within(-1, 6),
            [](O & o) -> auto& { return o.subdivisions; })
        .number(
            "random_candidates", "views", "drawn besides, anywhere", within(0, 1e6),
            [](O & o) -> auto& { return o.random_candidates; })
        .number(
            "aimed_candidates", "views", "drawn besides, at unknown cells, from up to the largest radius",
            within(0, 1e6), [](O & o) -> auto& { return o.aimed.count; })
        .number(
            "min_overlap_cells", "cells", "occupied cells of the object a view must see (h_oc)", at_least(0),
            [](O & o) -> auto& { return o.min_overlap_cells; })
        .number(
            "min_unknown_cells", "cells", "unknown cells of the object a view must see", at_least(1),
            [](O & o) -> auto& { return o.min_unknown_cells; })
        .choice(
            "gain", "what new surface is worth", gains, [](O & o) -> auto& { return o.gain; })
        .choice(
            "choice", "which view is taken",
            std::vector<std::pair<std::string_view, ViewChoice>>{{"cover", ViewChoice::Cover},
                                                                 {"greedy", ViewChoice::Greedy}},
            [](O & o) -> auto& { return o.choice; })
        .choice(
            "method", "how views are evaluated",
            std::vector<std::pair<std::string_view, VisibilityMethod>>{
                {"default", VisibilityMethod::Exact},
                {"uniform", VisibilityMethod::Uniform},
                {"hierarchical", VisibilityMethod::Hierarchical}},
            [](O & o) -> auto& { return o.method; })
        .number(
            "hypotheses", "views", "without an object: weighed per plan", within(1, 1e6),
            [](O & o) -> auto& { return o.hypotheses; });
    return made;
  }();
  return table;
}

const SettingTable<TourOptions>& tour_settings() {
  using O = TourOptions;
  static const auto table =
      with_survey<O>("TourOptions", [](O& o) -> FrontierSurveyOptions& { return o.survey; })
          .choice(
              "cost", "what a tour is to save: seconds or metres",
              std::vector<std::pair<std::string_view, TourCost>>{{"time", TourCost::Time}, {"path", TourCost::Path}},
              [](O & o) -> auto& { return o.cost; })
          .number(
              "site_m", "m", "largest extent of a part of the frontier that one view is to cover", more_than(0),
              [](O & o) -> auto& { return o.site_m; })
          .number(
              "most_sites", "", "the nearest parts that a tour leads over", within(1, 200),
              [](O & o) -> auto& { return o.most_sites; });
  return table;
}

}  // namespace vantage::detail
