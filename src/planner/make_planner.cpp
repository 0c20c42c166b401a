// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vantage/planner/frontier_gain_planner.hpp>
#include <vantage/planner/frontier_void_planner.hpp>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/planner/nearest_frontier_planner.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/planner/object_planner.hpp>

namespace vantage {
namespace {

std::string listing(const std::vector<std::string_view>& names) {
  std::string list;
  for (const std::string_view name : names) {
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  return list;
}

// Reads settings into options: each name is known once, beside the field it sets.
class SettingReader {
 public:
  SettingReader(std::string_view planner, const PlannerSettings& settings) : planner_(planner), settings_(settings) {}

  template <class Number>
  SettingReader& number(std::string_view name, Number& field) {
    if (const std::string* text = find(name)) {
      const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), field);
      if (error != std::errc{} || end != text->data() + text->size()) {
        refuse(name, *text, std::is_integral_v<Number> ? "a whole number" : "a number");
      }
    }
    return *this;
  }
  // Degrees, kept as radians.
  SettingReader& degrees(std::string_view name, double& field) {
    double angle_deg = std::numeric_limits<double>::quiet_NaN();
    number(name, angle_deg);
    if (!std::isnan(angle_deg)) {
      field = angle_deg * std::numbers::pi / 180.0;
    }
    return *this;
  }
  SettingReader& flag(std::string_view name, bool& field) {
    if (const std::string* text = find(name)) {
      if (*text != "true" && *text != "false") {
        refuse(name, *text, "true or false");
      }
      field = *text == "true";
    }
    return *this;
  }
  template <class Enum>
  SettingReader& choice(std::string_view name, Enum& field,
                        const std::vector<std::pair<std::string_view, Enum>>& values) {
    if (const std::string* text = find(name)) {
      std::vector<std::string_view> names;
      for (const auto& [value_name, value] : values) {
        if (value_name == *text) {
          field = value;
          return *this;
        }
        names.push_back(value_name);
      }
      refuse(name, *text, "one of " + listing(names));
    }
    return *this;
  }
  // "x,y,...".
  SettingReader& numbers(std::string_view name, std::vector<double>& field) {
    if (const std::string* text = find(name)) {
      field = numbers_in(*text);
      if (field.empty()) {
        refuse(name, *text, "numbers, with commas between them");
      }
    }
    return *this;
  }
  // "x0,y0,z0,x1,y1,z1", metres.
  SettingReader& box(std::string_view name, std::optional<Box>& field) {
    if (const std::string* text = find(name)) {
      const std::vector<double> corners = numbers_in(*text);
      if (corners.size() != 6) {
        refuse(name, *text, "six numbers x0,y0,z0,x1,y1,z1");
      }
      field = Box{{corners[0], corners[1], corners[2]}, {corners[3], corners[4], corners[5]}};
    }
    return *this;
  }
  // Whether one of these was given.
  [[nodiscard]] bool any_of(std::initializer_list<std::string_view> names) const {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return settings_.find(name) != settings_.end(); });
  }
  // Throws if a setting was given that none of the calls above knows.
  void done() const {
    for (const auto& [name, value] : settings_) {
      if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
        throw std::invalid_argument("planner '" + std::string(planner_) + "' has no setting '" + name +
                                    "'; it has: " + listing(known_));
      }
    }
  }

 private:
  // None if the text is anything else.
  static std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    const char* const end = text.data() + text.size();
    for (const char* at = text.data();; ++at) {
      const auto [after, error] = std::from_chars(at, end, numbers.emplace_back());
      if (error != std::errc{} || (after != end && *after != ',')) {
        return {};
      }
      if (after == end) {
        return numbers;
      }
      at = after;
    }
  }
  const std::string* find(std::string_view name) {
    known_.push_back(name);
    const auto setting = settings_.find(name);
    return setting == settings_.end() ? nullptr : &setting->second;
  }
  [[noreturn]] void refuse(std::string_view name, const std::string& text, const std::string& rule) const {
    throw std::invalid_argument("planner '" + std::string(planner_) + "': setting '" + std::string(name) + "' is '" +
                                text + "', must be " + rule);
  }

  std::string_view planner_;
  const PlannerSettings& settings_;
  std::vector<std::string_view> known_;
};

SettingReader& read_survey(SettingReader& read, FrontierSurveyOptions& options) {
  return read.number("min_cluster_cells", options.min_cluster_cells)
      .number("min_contested_cluster_cells", options.min_contested_cluster_cells)
      .flag("worn_frontiers", options.worn_frontiers)
      .flag("surfaces_first", options.surfaces_first)
      .number("patience", options.patience)
      .number("sight_directions", options.sight_directions)
      .number("exhaustive_pairs", options.exhaustive_pairs);
}

std::unique_ptr<ExplorationPlanner> make_frontier_gain(const PlannerSetup& setup, SettingReader& read) {
  FrontierGainOptions options;
  read_survey(read, options.survey)
      .number("hypotheses", options.hypotheses)
      .number("aimed_share", options.aimed_share)
      .number("cost_per_m", options.cost_per_m)
      .done();
  return std::make_unique<FrontierGainPlanner>(setup, options);
}

std::unique_ptr<ExplorationPlanner> make_frontier_void(const PlannerSetup& setup, SettingReader& read) {
  FrontierVoidOptions options;
  bool faithful = false;
  bool travelling = false;
  read.flag("faithful", faithful).flag("travelling", travelling);
  if (faithful && travelling) {
    throw std::invalid_argument("planner 'frontier-void': 'faithful' and 'travelling' exclude each other");
  }
  if (faithful) {
    options.strategy = FrontierVoidStrategy::faithful();
  } else if (travelling) {
    options.strategy = FrontierVoidStrategy::travelling();
  }
  read_survey(read, options.survey)
      .choice("score", options.clusters.score,
              {{"volume-ratio", FitScore::VolumeRatio}, {"literal", FitScore::Literal}})
      .number("min_score", options.clusters.min_score)
      .number("most_vectors", options.most_vectors)
      .number("views", options.views)
      .choice("share", options.strategy.share,
              {{"touching-cells", FrontierShare::TouchingCells}, {"whole-clusters", FrontierShare::WholeClusters}})
      .number("orientations_per_place", options.strategy.orientations_per_place)
      .number("place_spacing_m", options.strategy.place_spacing_m)
      .flag("aimed", options.strategy.aimed)
      .number("cost_per_m", options.strategy.cost_per_m)
      .flag("along_way", options.strategy.along_way)
      .number("near_views", options.strategy.near_views)
      .number("refinements", options.strategy.refinements)
      .number("finalists", options.strategy.finalists)
      .number("opaque_share", options.strategy.opaque_share)
      .number("opaque_beside_surface", options.strategy.opaque_beside_surface)
      .number("sought_chance", options.strategy.sought_chance)
      .number("least_view_dm3", options.strategy.least_view_dm3)
      .flag("beyond_voids", options.strategy.beyond_voids)
      .done();
  return std::make_unique<FrontierVoidPlanner>(setup, options);
}

std::unique_ptr<ExplorationPlanner> make_nearest_frontier(const PlannerSetup& setup, SettingReader& read) {
  FrontierSurveyOptions options;
  read_survey(read, options).done();
  return std::make_unique<NearestFrontierPlanner>(setup, options);
}

std::unique_ptr<ExplorationPlanner> make_harmonic(const PlannerSetup& setup, SettingReader& read) {
  HarmonicOptions options;
  bool faithful = false;
  if (read.flag("faithful", faithful); faithful) {
    options.strategy = HarmonicStrategy::faithful();
  }
  read_survey(read, options.survey)
      .choice("solver", options.solver,
              {{"multigrid", FieldSolver::Multigrid},
               {"coarse-to-fine", FieldSolver::CoarseToFine},
               {"gauss-seidel", FieldSolver::GaussSeidel}})
      .choice("neumann", options.neumann,
              {{"finite-volume", NeumannScheme::FiniteVolume}, {"mirror", NeumannScheme::Mirror}})
      .number("tolerance", options.tolerance)
      .number("smoothing_sweeps", options.smoothing_sweeps)
      .number("max_sweeps", options.max_sweeps)
      .number("over_relaxation", options.over_relaxation)
      .number("uniform_source", options.uniform_source)
      .number("detour_m", options.strategy.detour_m)
      .choice("sink_choice", options.strategy.sink_choice,
              {{"steepest", SinkChoice::Steepest}, {"largest-flux", SinkChoice::LargestFlux}})
      .flag("look_early", options.strategy.look_early)
      .number("look_spacing_m", options.strategy.look_spacing_m)
      .number("look_again_dm3", options.strategy.look_again_dm3)
      .flag("shortest_way", options.strategy.shortest_way)
      .flag("spare_scans", options.strategy.spare_scans)
      .done();
  return std::make_unique<HarmonicPlanner>(setup, options);
}

std::unique_ptr<ExplorationPlanner> make_next_best_view(const PlannerSetup& setup, SettingReader& read) {
  NextBestViewOptions options;
  std::vector<std::pair<std::string_view, RayGainMaker>> gains{{"unknown-cells", nullptr}};
  for (const std::string_view name : ray_gain_names()) {
    gains.emplace_back(name, ray_gain_named(name));
  }
  ObjectPlannerOptions of_surface;
  // The paper's own settings ask for its way to choose.
  bool by_cells = read.any_of({"gain", "choice", "min_unknown_cells", "min_overlap_cells", "failed_within_deg",
                               "vision_angle_deg", "min_depth_m", "max_depth_m"});
  read_survey(read, options.survey)
      .box("object", options.object)
      .numbers("radii_m", options.radii_m)
      .number("subdivisions", options.subdivisions)
      .number("random_candidates", options.random_candidates)
      .number("aimed_candidates", options.aimed.count)
      .number("aimed_min_distance_m", options.aimed.min_distance_m)
      .number("aimed_max_distance_m", options.aimed.max_distance_m)
      .number("min_overlap_cells", options.min_overlap_cells)
      .degrees("failed_within_deg", options.failed_within_rad)
      .number("min_unknown_cells", options.min_unknown_cells)
      .choice("gain", options.gain, gains)
      .degrees("vision_angle_deg", options.sensing.max_incidence_rad)
      .number("min_depth_m", options.sensing.min_depth_m)
      .number("max_depth_m", options.sensing.max_depth_m)
      .choice("choice", options.choice, {{"cover", ViewChoice::Cover}, {"greedy", ViewChoice::Greedy}})
      .choice("method", options.method,
              {{"default", VisibilityMethod::Exact},
               {"uniform", VisibilityMethod::Uniform},
               {"hierarchical", VisibilityMethod::Hierarchical}})
      .number("hierarchical_levels", options.hierarchical_levels)
      .number("hypotheses", options.hypotheses)
      .number("min_new_share", of_surface.min_new_share)
      .number("near_share", of_surface.near_share)
      .done();
  by_cells = by_cells || options.method != VisibilityMethod::Exact;
  if (!options.object || by_cells) {
    return std::make_unique<NextBestViewPlanner>(setup, options);
  }
  of_surface.object = *options.object;
  of_surface.radii_m = options.radii_m;
  of_surface.subdivisions = options.subdivisions;
  of_surface.random_candidates = options.random_candidates;
  of_surface.aimed = options.aimed;
  return std::make_unique<ObjectPlanner>(setup, of_surface);
}

using Maker = std::unique_ptr<ExplorationPlanner> (*)(const PlannerSetup&, SettingReader&);

const std::vector<std::pair<std::string_view, Maker>>& makers() {
  static const std::vector<std::pair<std::string_view, Maker>> all{
      {"frontier-gain", make_frontier_gain},
      {"frontier-void", make_frontier_void},
      {"harmonic", make_harmonic},
      {"nearest-frontier", make_nearest_frontier},
      {"next-best-view", make_next_best_view},
  };
  return all;
}

}  // namespace

std::unique_ptr<ExplorationPlanner> make_planner(std::string_view name, const PlannerSetup& setup,
                                                 const PlannerSettings& settings) {
  for (const auto& [known, make] : makers()) {
    if (known == name) {
      SettingReader read(name, settings);
      return make(setup, read);
    }
  }
  throw std::invalid_argument("there is no planner '" + std::string(name) +
                              "'; there are: " + listing(planner_names()));
}

const std::vector<std::string_view>& planner_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const auto& [name, make] : makers()) {
      all.push_back(name);
    }
    return all;
  }();
  return names;
}

}  // namespace vantage
