// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vantage/evaluation/run_figures.hpp>

namespace vantage {
namespace {

using Json = nlohmann::json;

std::optional<double> number_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

// Seen coverage if there is one, else coverage; of a report or of one of its cycles.
std::optional<double> covered_in(const Json& measured) {
  const std::optional<double> seen = number_in(measured, "seen_coverage");
  return seen ? seen : number_in(measured, "coverage");
}

}  // namespace

RunFigures run_figures(std::string_view report) {
  try {
    const Json json = Json::parse(report);
    RunFigures run;
    run.command = json.at("command").get<std::string>();
    run.world = json.at("world").get<std::string>();
    run.planner = json.at("planner").get<std::string>();
    run.seed = json.at("seed").get<std::uint64_t>();
    run.resolution_m = json.at("resolution_m").get<double>();
    run.outcome = json.at("outcome").get<std::string>();
    run.views = json.at("views").get<std::size_t>();
    run.path_m = json.at("path_length_m").get<double>();
    run.turned_deg = number_in(json, "turned_deg").value_or(0.0);
    run.duration_s = number_in(json, "duration_s");
    run.covered = covered_in(json);
    run.collisions = json.at("collisions").get<std::size_t>();
    for (const Json& cycle : json.at("cycles")) {
      run.after_views.push_back({.view = cycle.at("view").get<std::size_t>(),
                                 .path_m = cycle.at("path_length_m").get<double>(),
                                 .time_s = number_in(cycle, "time_s"),
                                 .covered = covered_in(cycle)});
      const double plan_ms = cycle.at("plan_ms").get<double>();
      run.computing_s += (cycle.at("insert_ms").get<double>() + plan_ms) / 1000.0;
      if (plan_ms > 0.0) {  // 0: the previous plan was still followed
        run.plan_ms.push_back(plan_ms);
      }
    }
    return run;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(std::string("run_figures: no report of a run: ") + error.what());
  }
}

std::optional<KnownSoFar> first_known(const RunFigures& run, double share) {
  const auto found = std::find_if(run.after_views.begin(), run.after_views.end(),
                                  [&](const KnownSoFar& after) { return after.covered && *after.covered >= share; });
  return found == run.after_views.end() ? std::nullopt : std::optional(*found);
}

}  // namespace vantage
