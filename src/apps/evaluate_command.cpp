// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vantage/evaluation/spread.hpp>
#include <vantage/evaluation/test_objects.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/sim/mesh_file.hpp>
#include <vector>

#include "apps/evaluate_exploration.hpp"
#include "apps/explore_request.hpp"
#include "apps/help_format.hpp"
#include "apps/object_run.hpp"
#include "apps/report_commands.hpp"
#include "apps/run_printer.hpp"
#include "apps/shared_options.hpp"

namespace vantage::apps {
namespace {

using TrialJson = nlohmann::json;

// Options of `vantage evaluate objects`.
struct EvaluateRequest {
  std::vector<std::string> objects;
  std::vector<std::string> planners{"next-best-view", "evenly-spaced", "random-views", "oracle-greedy"};
  std::vector<std::string> sensors{"vpl", "vpl+", "kinect", "kinect+"};
  std::vector<double> resolutions_m{0.01, 0.005};
  std::size_t starts = 5;
  std::string results;
  bool quick = false;
  ExploreRequest run;
};

// One run.
struct Trial {
  std::string object;
  std::string planner;
  std::string sensor;
  double resolution_m = 0.01;
  std::uint64_t start = 1;
  std::size_t views = 20;  // after which it ends

  // What it is kept by in the file of results.
  [[nodiscard]] std::string key(const ExploreRequest& shared) const {
    char text[64];
    std::snprintf(text, sizeof text, " %g m, start %llu, %zu views", resolution_m,
                  static_cast<unsigned long long>(start), views);
    std::string key = object + ' ' + planner + ' ' + sensor + text;
    for (const std::string& setting : shared.settings) {
      key += ' ' + setting;
    }
    return key;
  }
};

// The generated objects and, where their files are, the scanned and modelled ones.
std::vector<std::string> objects_of_the_table() {
  const auto generated = generated_object_names();
  std::vector<std::string> objects(generated.begin(), generated.end());
  const char* const data = std::getenv("VANTAGE_DATA");
  if (data == nullptr || *data == '\0') {
    std::cerr << "VANTAGE_DATA is not set: bunny, dragon, fan and office chair are left out\n";
    return objects;
  }
  for (const char* file : {"stanford/bunny_res3_opencv.ply", "stanford/dragon_vrip_res3.ply@3",
                           "household/tableFan.obj@0.01,y", "household/office_chair.obj@1,y"}) {
    objects.push_back(std::string(data) + "/meshes/" + file);
  }
  return objects;
}

// The stem of a mesh file, or the name of a generated object.
std::string short_name(const std::string& object) {
  return std::filesystem::path(object.substr(0, object.find('@'))).stem().string();
}

// NAME[:SEED] of a generated object, or FILE[@SCALE[,y]] of a mesh.
TriangleMesh object_of(const std::string& text) {
  const auto generated = generated_object_names();
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  if (std::find(generated.begin(), generated.end(), name) != generated.end()) {
    return generated_object(name, colon == std::string::npos ? 1 : std::stoull(text.substr(colon + 1)));
  }
  const std::size_t at = text.find('@');
  const std::string how = at == std::string::npos ? "1" : text.substr(at + 1);
  const bool y_up = how.size() > 2 && how.ends_with(",y");
  const TriangleMesh mesh =
      read_mesh_file(text.substr(0, at), {.up = y_up ? MeshFileOptions::Up::Y : MeshFileOptions::Up::Z});
  TriangleMesh scaled;
  scaled.append(mesh, Pose::Identity(), std::stod(how));
  return scaled;
}

// NAME or FILE.json; with a + after it the sensor reports rays without return.
RangeSensor sensor_named(const std::string& name, const ExploreRequest& shared) {
  ExploreRequest request = shared;
  const bool reports = name.ends_with('+');
  request.sensor = reports ? name.substr(0, name.size() - 1) : name;
  RangeSensor sensor = sensor_of(request);
  sensor.reports_no_return = sensor.reports_no_return || reports;
  return sensor;
}

TrialJson result_of(const Trial& trial, const ExploreRequest& shared) {
  const TriangleMesh object = object_of(trial.object);
  const RangeSensor sensor = sensor_named(trial.sensor, shared);
  const ObjectScene scene = object_scene(
      object, sensor,
      {.name = trial.object, .resolution_m = trial.resolution_m, .body_radius_m = shared.robot_radius_m});
  ExploreRequest request = shared;
  request.planner = trial.planner;
  request.resolution_m = trial.resolution_m;
  request.seed = trial.start;
  request.max_views = trial.views;
  const auto platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = shared.robot_radius_m});
  ExplorationRunOptions options = object_run_options(request, scene, object);
  options.measure_coverage = false;
  ExplorationRun run(scene.world, sensor, platform, options);
  Settings settings = planner_settings(scene);
  for (const auto& [name, value] : settings_of(shared)) {
    settings.insert_or_assign(name, value);
  }
  const ObjectRunPlanner made =
      object_run_planner(request, {.sensor = sensor, .platform = platform, .seed = trial.start}, scene, run,
                         options.object_surface, settings);
  const Pose start = made.first_view.value_or(draw_first_view(scene, run.truth(), *platform, trial.start));
  const auto began = std::chrono::steady_clock::now();
  const RunRecord record = run.run(*made.planner, start);
  TrialJson result{
      {"key", trial.key(shared)},
      {"object", trial.object},
      {"planner", trial.planner},
      {"seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()},
      {"outcome", to_string(record.outcome)},
      {"observable", *record.seen_observable > 0.0 ? *record.seen_coverage / *record.seen_observable : 0.0},
      {"turned_deg", record.turned_deg},
      {"seen", TrialJson::array()},
      {"path_m", TrialJson::array()},
      {"plan_ms", TrialJson::array()}};
  for (const ViewRecord& view : record.views) {
    result["seen"].push_back(*view.seen_coverage);
    result["path_m"].push_back(view.path_length_m);
    result["plan_ms"].push_back(view.plan_ms);
  }
  return result;
}

std::map<std::string, TrialJson> results_in(const std::string& file) {
  std::map<std::string, TrialJson> results;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {  // none yet, or a device, which may never end
    return results;
  }
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    TrialJson result = TrialJson::parse(line, nullptr, false);
    // An interrupted run may leave half a line, and older lines lack the turn.
    if (result.is_object() && result.contains("turned_deg") && result.value("key", TrialJson()).is_string()) {
      results.insert_or_assign(result.at("key").get<std::string>(), result);
    }
  }
  return results;
}

void require_written(const std::ofstream& out, const std::string& file) {
  if (!out) {
    throw std::runtime_error(file + ": cannot be written: " + std::generic_category().message(errno));
  }
}

// The value after so many views, or the last one.
double at_view(const TrialJson& list, std::size_t view) {
  return list.empty() ? 0.0 : list.at(std::min(view, list.size()) - 1).get<double>();
}

// The first view after which 95 % of what can be seen was seen; infinite if there is none.
double view_of_enough(const TrialJson& result) {
  const TrialJson& seen = result.at("seen");
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].get<double>() >= 0.95 * result.at("observable").get<double>()) {
      return static_cast<double>(i + 1);
    }
  }
  return std::numeric_limits<double>::infinity();
}

constexpr std::array<std::size_t, 8> kShown{1, 2, 3, 4, 5, 6, 8, 10};  // views

void print_row(const std::string& what, const std::string& planner, const std::vector<const TrialJson*>& results) {
  std::printf("| %s | %s |", what.c_str(), planner.c_str());
  const auto cell = [&](int digits, const auto& value) {
    std::vector<double> values;
    values.reserve(results.size());
    for (const TrialJson* result : results) {
      values.push_back(value(*result));
    }
    std::printf(" %s |", spread_text(values, digits).c_str());
  };
  for (const std::size_t view : kShown) {
    cell(0, [&](const TrialJson& r) { return 100.0 * at_view(r.at("seen"), view); });
  }
  cell(0, [](const TrialJson& r) { return 100.0 * r.at("observable").get<double>(); });
  cell(0, view_of_enough);
  cell(1, [](const TrialJson& r) {
    const double view = view_of_enough(r);
    return std::isinf(view) ? view : at_view(r.at("path_m"), static_cast<std::size_t>(view));
  });
  cell(0, [](const TrialJson& r) { return static_cast<double>(r.at("seen").size()); });
  cell(1, [](const TrialJson& r) { return r.at("path_m").back().get<double>(); });
  cell(0, [](const TrialJson& r) { return r.at("turned_deg").get<double>(); });
  cell(1, [](const TrialJson& r) { return r.at("seconds").get<double>(); });
  std::printf("\n");
}

// Results by what a row is about and by planner, in the order in which they were added.
struct ResultRows {
  std::vector<std::string> about;
  std::map<std::pair<std::string, std::string>, std::vector<const TrialJson*>> results;

  void add(const std::string& what, const std::string& planner, const TrialJson& result) {
    if (std::find(about.begin(), about.end(), what) == about.end()) {
      about.push_back(what);
    }
    results[{what, planner}].push_back(&result);
  }
  void print(const char* title, const std::vector<std::string>& planners) const {
    std::printf("| %s | planner | seen, %%, after 1 |", title);
    for (std::size_t i = 1; i < kShown.size(); ++i) {
      std::printf(" %zu |", kShown[i]);
    }
    std::printf(
        " can be seen | views to 95 %% of it | path to it, m | views | path, m | turned, deg | s |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& what : about) {
      for (const std::string& planner : planners) {
        print_row(what, planner, results.at({what, planner}));
      }
    }
  }
};

// Tells on stderr how far the table has come: a bar on a terminal, otherwise a line per run.
class ObjectProgress {
 public:
  explicit ObjectProgress(std::size_t all) : all_(all), terminal_(isatty(STDERR_FILENO) != 0) {}

  // Before the run number `at`. Those left take as long as those made, on average; runs found in a file take no time.
  void tell(std::size_t at, const std::string& what) const {
    std::string text = terminal_ ? "\r" + drawn_bar(static_cast<double>(at) / static_cast<double>(all_)) : "";
    text += std::to_string(at + 1) + " of " + std::to_string(all_);
    if (made_ > 0) {
      const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - began_;
      text += ", about " +
              rounded_time(so_far.count() / static_cast<double>(made_) * static_cast<double>(all_ - at)) + " left";
    }
    std::cerr << text << "  " << what << (terminal_ ? "\x1b[K" : "\n") << std::flush;
  }
  void made() { ++made_; }
  void finish() const { std::cerr << (terminal_ ? "\r\x1b[K" : "") << std::flush; }

 private:
  std::size_t all_;
  std::size_t made_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

void evaluate_objects(EvaluateRequest& request) {
  if (request.quick) {
    request.starts = 1;
    request.sensors = {"vpl+"};
    request.resolutions_m = {0.02};
  }
  std::map<std::string, TrialJson> done =
      request.results.empty() ? std::map<std::string, TrialJson>() : results_in(request.results);
  std::ofstream out;
  if (!request.results.empty()) {
    out.open(request.results, std::ios::app);
    require_written(out, request.results);
  }
  if (request.objects.empty()) {
    request.objects = objects_of_the_table();
  }
  ResultRows by_object;
  ResultRows by_sensor;
  const std::size_t all = request.objects.size() * request.sensors.size() * request.resolutions_m.size() *
                          request.starts * request.planners.size();
  std::size_t count = 0;
  ObjectProgress progress(all);
  for (const std::string& object : request.objects) {
    for (const std::string& sensor : request.sensors) {
      for (const double resolution_m : request.resolutions_m) {
        for (std::uint64_t start = 1; start <= request.starts; ++start) {
          std::size_t taken = request.run.max_views;  // views taken by the planner under test
          for (const std::string& planner : request.planners) {
            const std::size_t views = planner == "evenly-spaced" ? taken : request.run.max_views;
            const Trial trial{object, planner, sensor, resolution_m, start, views};
            const std::string key = trial.key(request.run);
            progress.tell(count++, key);
            auto found = done.find(key);
            if (found == done.end()) {
              found = done.emplace(key, result_of(trial, request.run)).first;
              progress.made();
              if (!request.results.empty()) {
                out << found->second.dump() << '\n' << std::flush;
                require_written(out, request.results);
              }
            }
            if (planner == "next-best-view") {
              taken = found->second.at("seen").size();
            }
            by_object.add(short_name(object), planner, found->second);
            char cells[32];
            std::snprintf(cells, sizeof cells, ", %g m", resolution_m);
            by_sensor.add(sensor + cells, planner, found->second);
          }
        }
      }
    }
  }
  progress.finish();
  by_object.print("object", request.planners);
  std::printf("\n");
  by_sensor.print("sensor, cells", request.planners);
}

}  // namespace

void add_evaluate_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("evaluate", "Print tables of planners beside their peers");
  command->require_subcommand(1);
  command->footer("Examples:\n  vantage evaluate exploration --help\n  vantage evaluate objects --help");
  add_evaluate_exploration_command(*command, exit_code);
  const auto request = std::make_shared<EvaluateRequest>();
  request->run.robot_radius_m = 0.05;
  request->run.max_views = 20;
  CLI::App* objects =
      command->add_subcommand("objects", "Share of objects seen after each view, and the length of the path");
  const auto option = [&](const char* name, auto& value, const char* type, const char* about) {
    return objects->add_option(name, value, about)->type_name(type);
  };
  option("--objects", request->objects, "NAME[:SEED]|FILE[@SCALE[,y]];...",
         "Generated objects and meshes; default: nine generated ones and four meshes of VANTAGE_DATA")
      ->delimiter(';');
  option("--planners", request->planners, "NAME,...", "next-best-view, or a peer of vantage reconstruct --planner")
      ->delimiter(',')
      ->capture_default_str();
  option("--sensors", request->sensors, "NAME,...", "A name with + reports rays without return")
      ->delimiter(',')
      ->capture_default_str();
  option("--resolutions", request->resolutions_m, "M,...", "Edges of the cells, metres")
      ->delimiter(',')
      ->capture_default_str();
  option("--starts", request->starts, "N", "Number of first views per object")->capture_default_str();
  option("--results", request->results, "FILE", "File that stores every run; stored runs are not repeated");
  option("--max-views", request->run.max_views, "N", "Scans after which a run ends")->capture_default_str();
  objects->add_flag("--quick", request->quick, "One start, one sensor, 0.02 m");
  add_setting_option(*objects, request->run, "A setting of the planner next-best-view");
  objects->footer(
      "Examples:\n"
      "  vantage evaluate objects --quick\n"
      "  vantage evaluate objects --resolutions 0.01 --starts 2 --results runs.jsonl\n"
      "  vantage evaluate objects --quick --objects 'mug:11;bunny.ply' --set aimed_candidates=640");
  objects->callback([request] { evaluate_objects(*request); });
}

}  // namespace vantage::apps
