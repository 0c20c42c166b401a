// SPDX-License-Identifier: MIT
#include "apps/evaluation_runs.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vantage/report/report_json.hpp>
#include <vantage/sim/exploration_run.hpp>

#include <vantage/map/impl/whole_file.hpp>
#include "apps/run_files.hpp"
#include "apps/simulated_run.hpp"

namespace vantage::apps {
namespace {

using StoredJson = nlohmann::ordered_json;
using RunClock = std::chrono::steady_clock;

double seconds_since(RunClock::time_point began) {
  return std::chrono::duration<double>(RunClock::now() - began).count();
}

std::optional<std::string> content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return in ? std::optional(std::string(std::istreambuf_iterator<char>(in), {})) : std::nullopt;
}

// The beginning of a kept file: only what was made with the same options counts.
std::string head_of(const std::string& options) { return "{\n  \"options\": " + StoredJson(options).dump() + ",\n"; }

std::string options_of_start(const EvaluationStart& at) {
  return options_of(*at.world) + " --seed " + std::to_string(at.start);
}

// A run that can be repeated from one start with one planner after another.
class StartedWorld {
 public:
  StartedWorld(const EvaluationFolder& folder, const EvaluationStart& at, int threads,
               const EvaluationObserver& observer)
      : request_(request_in(folder.folder(), options_of_start(at))), carrier_(carrier_of(request_)) {
    request_.threads = threads;
    const auto [world, region] = explored_world(request_);
    ExplorationRunOptions options = run_options_of(request_, carrier_, region);
    options.stop = observer.stop;
    options.on_observable_share = [&observer](double share) {
      observer.on_work("what can be observed, " + std::to_string(static_cast<int>(100.0 * share)) + " %");
    };
    run_.emplace(world, carrier_.sensor, carrier_.platform, options);
    start_ = start_in(*run_, *carrier_.platform, request_);
  }

  [[nodiscard]] RunRecord run(const std::string& options, const EvaluationFolder& folder,
                              const std::function<void(const ViewRecord&)>& on_view) {
    ExploreRequest request = request_in(folder.folder(), options);
    request.threads = request_.threads;
    const auto planner = planner_of(request, carrier_);
    RunRecord record = run_->run(*planner, start_, [&](const ViewRecord& view, const auto&) { on_view(view); });
    tell_request(record, request);
    return record;
  }
  [[nodiscard]] PathBound bound(BoundWith with) const {
    return bound_of(*run_, carrier_, start_, with, request_.threads);
  }

 private:
  ExploreRequest request_;
  SensorCarrier carrier_;
  std::optional<ExplorationRun> run_;
  Pose start_ = Pose::Identity();
};

}  // namespace

std::string planner_options(const PlannerText& planner) {
  std::string options = "--planner " + planner.substr(0, planner.find(','));
  for (std::size_t comma = planner.find(','); comma != std::string::npos;) {
    const std::size_t next = planner.find(',', comma + 1);
    const std::string setting = planner.substr(comma + 1, next == std::string::npos ? next : next - comma - 1);
    if (setting.find('=') == std::string::npos || setting.front() == '=') {
      throw std::invalid_argument("--planners: '" + setting + "' behind " + planner.substr(0, comma) +
                                  " must be KEY=VALUE");
    }
    options += " --set " + setting;
    comma = next;
  }
  return options;
}

std::filesystem::path EvaluationFolder::file_of(const EvaluationStart& at, const std::string& name) const {
  std::string file = name + "-" + std::to_string(at.start) + ".json";
  std::replace_if(
      file.begin(), file.end(),
      [](unsigned char c) {
        return std::isalnum(c) == 0 && std::string_view("-_.,=").find(static_cast<char>(c)) == std::string_view::npos;
      },
      '_');
  return folder_ / "runs" / std::string(at.world->name) / file;
}

std::string EvaluationFolder::options_of_run(const EvaluationStart& at, const PlannerText& planner) {
  return options_of_start(at) + " " + planner_options(planner);
}

std::optional<StoredRun> EvaluationFolder::run(const EvaluationStart& at, const PlannerText& planner) const {
  const std::optional<std::string> content = content_of(file_of(at, planner));
  if (!content || !content->starts_with(head_of(options_of_run(at, planner)))) {
    return std::nullopt;
  }
  try {
    StoredRun stored{.figures = run_figures(*content)};
    const std::string_view key = "\"wall_s\": ";
    stored.wall_s = std::stod(content->substr(content->find(key) + key.size(), 32));
    return stored;
  } catch (const std::logic_error&) {  // what is broken is made again
    return std::nullopt;
  }
}

void EvaluationFolder::keep(const EvaluationStart& at, const PlannerText& planner, const RunRecord& record,
                            double wall_s) const {
  const std::filesystem::path file = file_of(at, planner);
  make_folder(file.parent_path());
  detail::write_whole_file(file, head_of(options_of_run(at, planner)) + "  \"wall_s\": " + StoredJson(wall_s).dump() +
                                     ",\n" + report_json(record).substr(2));  // less its "{\n"
}

std::optional<PathBound> EvaluationFolder::bound(const EvaluationStart& at) const {
  const std::optional<std::string> content = content_of(file_of(at, "bound"));
  if (!content || !content->starts_with(head_of(options_of_start(at)))) {
    return std::nullopt;
  }
  try {
    const StoredJson json = StoredJson::parse(*content);
    return PathBound{json.at("length_m").get<double>(), json.at("is_met").get<bool>()};
  } catch (const StoredJson::exception&) {
    return std::nullopt;
  }
}

void EvaluationFolder::keep(const EvaluationStart& at, const PathBound& bound) const {
  const std::filesystem::path file = file_of(at, "bound");
  make_folder(file.parent_path());
  detail::write_whole_file(file, head_of(options_of_start(at)) +
                                     "  \"length_m\": " + StoredJson(bound.length_m).dump() +
                                     ",\n  \"is_met\": " + (bound.is_met ? "true" : "false") + "\n}\n");
}

void make_runs(const EvaluationFolder& folder, const EvaluationStart& at, const std::vector<PlannerText>& planners,
               int threads, const EvaluationObserver& observer) {
  const bool wants_bound = at.world->bound && !folder.bound(at);
  if (planners.empty() && !wants_bound) {
    return;
  }
  RunClock::time_point began = RunClock::now();
  std::optional<StartedWorld> world;
  try {
    world.emplace(folder, at, threads, observer);
  } catch (const std::exception& error) {
    for (const PlannerText& planner : planners) {
      observer.on_failure(planner, error.what());
    }
    return;
  }
  for (const PlannerText& planner : planners) {
    if (observer.stop()) {
      return;
    }
    RunRecord record;
    try {
      record = world->run(EvaluationFolder::options_of_run(at, planner), folder,
                          [&](const ViewRecord& view) { observer.on_view(planner, view); });
    } catch (const std::exception& error) {
      observer.on_failure(planner, error.what());
      continue;
    }
    if (record.outcome == RunOutcome::Interrupted) {
      return;
    }
    const double wall_s = seconds_since(std::exchange(began, RunClock::now()));
    folder.keep(at, planner, record, wall_s);
    observer.on_run(planner, {.figures = run_figures(report_json(record)), .wall_s = wall_s});
  }
  if (wants_bound && !observer.stop()) {
    observer.on_work("a lower bound on the path");
    folder.keep(at, world->bound(*at.world->bound));
  }
}

}  // namespace vantage::apps
