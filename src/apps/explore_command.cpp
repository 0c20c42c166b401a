// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <vantage/sim/audit.hpp>
#include <vantage/sim/exploration_run.hpp>

#include "apps/commands.hpp"
#include "apps/explore_options.hpp"
#include "apps/mesh_doubts.hpp"
#include "apps/observable_progress.hpp"
#include "apps/progress_stream.hpp"
#include "apps/run_files.hpp"
#include "apps/run_printer.hpp"
#include "apps/run_recording.hpp"
#include "apps/shared_options.hpp"
#include "apps/simulated_run.hpp"

namespace vantage::apps {
namespace {

AuditRecord audit_of(const ExplorationRun& run, const SensorCarrier& carrier, const RunRecord& record, int threads) {
  std::vector<Pose> looked_from;
  for (const ViewRecord& view : record.views) {
    looked_from.push_back(view.pose);
  }
  const AuditResult found =
      audit(run.known(), *carrier.platform, carrier.sensor, looked_from.back(), looked_from, threads);
  return {.cells_checked = found.cells_checked,
          .looked_at_in_vain = found.looked_at_in_vain,
          .observable_left = found.observable_left};
}

// NOLINTNEXTLINE(readability-function-size): a run from its options to its files
int explore(const ExploreRequest& request) {
  Interruption interruption;
  check_numbers(request);
  check_targets(request.out, request.json);
  const SensorCarrier carrier = carrier_of(request);
  const auto planner = planner_of(request, carrier);
  const auto [world, region] = explored_world(request);
  if (!request.quiet) {
    std::cerr << doubts_about_world(request, world.mesh.bounds());
  }

  ExplorationRunOptions options = run_options_of(request, carrier, region);
  options.stop = [&interruption] { return interruption.asked(); };
  ObservableProgress observable(request.quiet);
  options.on_observable_share = [&](double share) { observable.tell(share); };
  ExplorationRun run(world, carrier.sensor, carrier.platform, options);

  ProgressStream told(request);
  std::ostream& progress = told.stream();
  RunPrinter printer(progress, told.is_terminal());
  PlanPictures pictures;
  RunRecording recording(*planner, request.out, recorder_setup(request, "explore", request.world, carrier.sensor));
  RunRecord record = run.run(
      recording, start_in(run, *carrier.platform, request), [&](const ViewRecord& view, const OccupancyMap& map) {
        if (view.view == 1) {
          interruption.hold();
          printer.head(request.planner, request.world, request.sensor, request.resolution_m, request.seed);
        }
        printer.view(view);
        recording.look(view, map);
        if (view.plan_ms > 0.0 && !request.out.empty()) {
          pictures.look(*planner, map, view);
        }
      });
  tell_request(record, request);
  printer.summary(record);
  if (record.coverage) {
    printer.observable(observable.seconds());
  }
  if (request.audit && !interruption.asked()) {
    printer.working("audit", "checking what could still be observed ...");
    record.audit = audit_of(run, carrier, record, request.threads);
    printer.audit(record);
  }
  if (request.bound && !interruption.asked()) {
    printer.working("bound", "computing the shortest route that sees all, or a lower bound ...");
    const PathBound bound = bound_of(run, carrier, record.views.front().pose, BoundWith::Route, request.threads,
                                     [&interruption] { return interruption.asked(); });
    if (!interruption.asked()) {
      record.path_bound = bound;
      printer.bound(record);
    }
  }
  recording.finish(record);
  progress << recording.cost(record);
  write_outputs(request.out, request.json, record, run.map(), carrier.sensor, pictures.pictures(), progress,
                recording);
  return exit_code_of(record.outcome, interruption);
}

}  // namespace

void add_explore_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("explore", "Let a simulated robot explore a known world");
  const auto request = std::make_shared<ExploreRequest>();
  add_explore_options(*command, *request);
  add_output_options(*command, *request);
  command->footer(
      "Examples:\n"
      "  vantage explore --world rooms --out rooms\n"
      "  vantage explore --world office --planner frontier-gain --sensor kinect --set hypotheses=300 --seed 7\n"
      "  vantage explore --world office --size 15,10 --band 0.2,1.4 --look-around --sensor stereo\n"
      "  vantage explore --world house.dae --up y --region -9,-5,0.1,9,5,2.4 --resolution 0.1 --json - --quiet\n"
      "Exit codes: 0 nothing observable is left, 2 bad input (nothing was written) or a file that cannot be\n"
      "written, 3 the views were spent, 4 something is left that cannot be reached, 130 and 143 interrupted.");
  command->callback([command, request, &exit_code] {
    if (command->count("--max-views") == 0 && request->scan_rate_hz) {
      constexpr double kHourS = 3600.0;
      request->max_views = static_cast<std::size_t>(std::clamp(kHourS * *request->scan_rate_hz, 1.0, 1e7));
    }
    exit_code = explore(*request);
  });
}

}  // namespace vantage::apps
