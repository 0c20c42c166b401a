// SPDX-License-Identifier: MIT
#include "apps/evaluate_exploration.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vantage/evaluation/exploration_peers.hpp>
#include <vantage/evaluation/exploration_table.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/report/report_html.hpp>
#include <vector>

#include <vantage/map/impl/whole_file.hpp>
#include <vantage/settings/impl/option_rule.hpp>
#include "apps/commands.hpp"
#include "apps/evaluation_progress.hpp"
#include "apps/evaluation_runs.hpp"
#include "apps/evaluation_worlds.hpp"
#include "apps/help_format.hpp"
#include "apps/run_files.hpp"
#include "apps/simulated_run.hpp"

namespace vantage::apps {
namespace {

// Options of `vantage evaluate exploration`.
struct EvaluateExplorationRequest {
  std::string out;
  std::vector<std::string> worlds;    // names and classes; empty: all
  std::vector<std::string> planners;  // split at commas; empty: all
  std::optional<std::size_t> starts;
  bool quick = false;
  int threads = 1;
  std::size_t jobs = 1;
};

using Worlds = std::vector<const EvaluationWorld*>;

bool has_data() { return std::getenv("VANTAGE_DATA") != nullptr; }

std::string joined(const std::vector<std::string>& names, const char* between = ", ") {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : between) + name;
  }
  return text;
}

// The worlds of a name or class.
Worlds worlds_named(const std::string& name) {
  Worlds found;
  for (const EvaluationWorld& world : evaluation_worlds()) {
    if (world.name == name || world.in_class == name) {
      found.push_back(&world);
    }
  }
  if (found.empty()) {
    std::vector<std::string> there;
    for (const EvaluationClass& each : evaluation_classes()) {
      there.emplace_back(each.name);
    }
    for (const EvaluationWorld& world : evaluation_worlds()) {
      there.emplace_back(world.name);
    }
    throw std::invalid_argument("--worlds: there is no '" + name + "'; there are the classes and worlds " +
                                joined(there));
  }
  return found;
}

// In the order of the table of worlds. Those whose data is not there are left out, or refused where they were named.
Worlds worlds_of(const EvaluateExplorationRequest& request) {
  Worlds named;
  for (const std::string& name : request.worlds) {
    const auto found = worlds_named(name);
    if (found.size() == 1 && found[0]->name == name && found[0]->needs_data() && !has_data()) {
      throw std::invalid_argument("--worlds " + name + ": VANTAGE_DATA must name the folder of the worlds");
    }
    named.insert(named.end(), found.begin(), found.end());
  }
  Worlds worlds;
  std::vector<std::string> left_out;
  for (const EvaluationWorld& world : evaluation_worlds()) {
    const bool asked = request.worlds.empty() ? !request.quick || world.quick
                                              : std::find(named.begin(), named.end(), &world) != named.end();
    if (asked && world.needs_data() && !has_data()) {
      left_out.emplace_back(world.name);
    } else if (asked) {
      worlds.push_back(&world);
    }
  }
  if (!left_out.empty()) {
    std::cerr << "VANTAGE_DATA is not set: " << joined(left_out) << " are left out\n";
  }
  return worlds;
}

// Joins what belongs to a planner: a part with "=" is a setting of the planner before it.
std::vector<PlannerText> planners_of(const EvaluateExplorationRequest& request) {
  std::vector<PlannerText> planners;
  for (const std::string& part : request.planners) {
    if (part.find('=') != std::string::npos && !planners.empty()) {
      planners.back() += ',' + part;
    } else {
      planners.push_back(part);
    }
  }
  if (planners.empty()) {
    for (const std::string_view name : planner_names()) {
      planners.emplace_back(name);
    }
    planners.emplace_back("harmonic,mode=faithful");
    for (const std::string_view name : exploration_peer_names()) {
      planners.emplace_back(name);
    }
  }
  // A wrong name or setting is found before the first run.
  for (const PlannerText& planner : planners) {
    ExploreRequest probe = request_in({}, "--world rooms " + planner_options(planner));
    (void)planner_of(probe, carrier_of(probe));
  }
  return planners;
}

std::size_t starts_of(const EvaluateExplorationRequest& request) {
  return request.starts.value_or(request.quick ? 2 : 5);
}

// The classes of these worlds, each with the command that prints its table alone.
std::vector<WorldClass> classes_of(const EvaluateExplorationRequest& request, const Worlds& worlds) {
  std::string options = request.planners.empty() ? "" : " --planners " + joined(request.planners, ",");
  options += request.starts ? " --starts " + std::to_string(*request.starts) : "";
  options += request.quick ? " --quick" : "";
  std::vector<WorldClass> classes;
  for (const EvaluationClass& each : evaluation_classes()) {
    const auto all = static_cast<std::size_t>(
        std::count_if(evaluation_worlds().begin(), evaluation_worlds().end(),
                      [&](const EvaluationWorld& world) { return world.in_class == each.name; }));
    WorldClass shown{.name = std::string(each.name), .about = std::string(each.about)};
    bool needs_data = false;
    for (const EvaluationWorld* world : worlds) {
      if (world->in_class == each.name) {
        shown.worlds.emplace_back(world->name);
        needs_data = needs_data || world->needs_data();
      }
    }
    shown.command = std::string(needs_data ? "VANTAGE_DATA=<data> " : "") +
                    "vantage evaluate exploration --out DIR --worlds " +
                    (shown.worlds.size() == all ? shown.name : joined(shown.worlds, ",")) + options;
    classes.push_back(std::move(shown));
  }
  return classes;
}

// What is to be run: units of one start, in which a world is made once for all planners.
struct Work {
  std::vector<EvaluationStart> starts;
  std::vector<PlannerText> planners;

  Work(const Worlds& worlds, std::size_t count, std::vector<PlannerText> all) : planners(std::move(all)) {
    for (const EvaluationWorld* world : worlds) {
      for (std::uint64_t start = 1; start <= count; ++start) {
        starts.push_back({.world = world, .start = start});
      }
    }
  }
};

// Makes what is not in the folder yet, `jobs` starts at a time. Returns what failed.
std::vector<std::string> make_all(const EvaluationFolder& folder, const Work& work,
                                  const EvaluateExplorationRequest& request, const Interruption& interruption) {
  EvaluationProgress progress(request.jobs);
  std::vector<std::vector<PlannerText>> missing(work.starts.size());
  for (std::size_t i = 0; i < work.starts.size(); ++i) {
    for (const PlannerText& planner : work.planners) {
      if (const std::optional<StoredRun> stored = folder.run(work.starts[i], planner)) {
        progress.found(work.starts[i], *stored);
      } else {
        progress.expect(work.starts[i]);
        missing[i].push_back(planner);
      }
    }
  }
  std::vector<std::string> failures;
  std::exception_ptr thrown;
  std::mutex mutex;
  std::atomic<std::size_t> next{0};
  const auto stopped = [&] {
    const std::scoped_lock lock(mutex);
    return interruption.asked() || thrown != nullptr;
  };
  const auto take_starts = [&] {
    for (std::size_t i = next++; i < work.starts.size() && !stopped(); i = next++) {
      const EvaluationStart& at = work.starts[i];
      const EvaluationObserver observer{
          .on_view = [&](const PlannerText& p, const ViewRecord& view) { progress.view(at, p, view); },
          .on_run = [&](const PlannerText& p, const StoredRun& run) { progress.made(at, p, run); },
          .on_failure =
              [&](const PlannerText& p, const std::string& message) {
                progress.failed(at, p, message);
                const std::scoped_lock lock(mutex);
                failures.push_back(p);
                failures.back().append(" in ").append(at.world->name).append(": ").append(message);
              },
          .on_work = [&](const std::string& doing) { progress.work(at, doing); },
          .stop = stopped};
      try {
        make_runs(folder, at, missing[i], request.threads, observer);
      } catch (...) {  // a file that cannot be written
        const std::scoped_lock lock(mutex);
        thrown = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (std::size_t job = 1; job < request.jobs; ++job) {
      workers.emplace_back(take_starts);
    }
    take_starts();
  }
  progress.finish();
  if (thrown) {
    std::rethrow_exception(thrown);
  }
  return failures;
}

std::vector<EvaluatedRun> runs_in(const EvaluationFolder& folder, const Work& work) {
  std::vector<EvaluatedRun> runs;
  for (const PlannerText& planner : work.planners) {  // rows come in this order
    for (const EvaluationStart& at : work.starts) {
      if (std::optional<StoredRun> stored = folder.run(at, planner)) {
        runs.push_back({.world = std::string(at.world->name),
                        .planner = planner,
                        .start = at.start,
                        .figures = std::move(stored->figures),
                        .bound = at.world->bound ? folder.bound(at) : std::nullopt});
      }
    }
  }
  return runs;
}

int evaluate_exploration(const EvaluateExplorationRequest& request) {
  Interruption interruption;
  detail::require_option(starts_of(request) > 0, "--starts", starts_of(request), "> 0");
  detail::require_option(request.jobs > 0 && request.jobs <= 64, "--jobs", request.jobs, "in [1, 64]");
  detail::require_option(request.threads > 0, "--threads", request.threads, "> 0");
  check_targets(request.out, "");
  const Worlds worlds = worlds_of(request);
  const Work work(worlds, starts_of(request), planners_of(request));
  const EvaluationFolder folder(request.out);
  make_folder(folder.folder());
  write_evaluation_sensors(folder.folder());
  interruption.hold();
  const std::vector<std::string> failures = make_all(folder, work, request, interruption);

  const std::vector<WorldClass> classes = classes_of(request, worlds);
  const std::vector<EvaluatedRun> runs = runs_in(folder, work);
  const std::string tables = exploration_tables(classes, runs);
  const std::string results = exploration_json(classes, runs);
  const std::vector<std::filesystem::path> files{folder.folder() / "table.md", folder.folder() / "results.json",
                                                 folder.folder() / "index.html"};
  detail::write_whole_file(files[0], tables);
  detail::write_whole_file(files[1], results);
  write_evaluation_html(results, files[2]);
  std::cout << tables << std::flush;
  tell_files(std::cerr, files);
  if (interruption.asked()) {
    std::cerr << "interrupted: " << runs.size() << " of " << work.starts.size() * work.planners.size()
              << " runs are there; the same command goes on\n";
    return interruption.exit_code();
  }
  if (!failures.empty()) {
    throw std::runtime_error(std::to_string(failures.size()) + " runs failed, the first: " + failures.front());
  }
  return kDone;
}

}  // namespace

void add_evaluate_exploration_command(CLI::App& evaluate, int& exit_code) {
  CLI::App* command = evaluate.add_subcommand("exploration", "Planners in the same worlds from the same starts");
  const auto request = std::make_shared<EvaluateExplorationRequest>();
  command->add_option("--out", request->out, "Folder for runs, table.md, results.json, index.html; required")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--worlds", request->worlds, "Worlds or classes of worlds; a wrong name lists them; default: all")
      ->type_name("NAME,...")
      ->delimiter(',');
  command->add_option("--planners", request->planners, "Planners with settings; default: all of vantage list")
      ->type_name("NAME[,KEY=VALUE]...")
      ->delimiter(',');
  command->add_option("--starts", request->starts, "Number of starts; start k is drawn from seed k")
      ->type_name("N")
      ->check(a_whole_number())
      ->default_str("5");
  command->add_flag("--quick", request->quick, "Two starts, and by default only small worlds: some minutes");
  command->add_option("--threads", request->threads, "Threads of each run; the results do not depend on it")
      ->type_name("N")
      ->check(a_whole_number(1024))
      ->capture_default_str();
  command
      ->add_option("--jobs", request->jobs, "Number of starts run in parallel; planning times grow if cores are few")
      ->type_name("N")
      ->check(a_whole_number(64))
      ->capture_default_str();
  command->footer(
      "Runs that are in DIR already are not repeated: the same command continues where it was interrupted.\n"
      "Examples:\n"
      "  vantage evaluate exploration --out quick --quick\n"
      "  vantage evaluate exploration --out offices --worlds office,first-office --planners "
      "harmonic,frontier-gain,hypotheses=300");
  command->callback([request, &exit_code] { exit_code = evaluate_exploration(*request); });
}

}  // namespace vantage::apps
