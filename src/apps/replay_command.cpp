// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/commands.hpp"
#include "apps/help_format.hpp"
#include "apps/progress_stream.hpp"
#include "apps/replay_files.hpp"
#include "apps/replay_request.hpp"
#include "apps/replay_run.hpp"
#include "apps/run_files.hpp"
#include "apps/run_printer.hpp"
#include "apps/run_recording.hpp"
#include "apps/select_run.hpp"
#include "apps/shared_options.hpp"
#include "apps/simulated_run.hpp"

namespace vantage::apps {
namespace {

std::string frame_line(const ReplayRecord& record, const Recording& recording, const Pose& pose) {
  const ReplayedFrame& frame = record.frames.back();
  char text[256];
  std::snprintf(text, sizeof text, "%-20s %6zu pixels  %7zu frontier  %7zu void cells  insert %6.1f ms\n",
                recording.frames()[frame.frame].name.c_str(), frame.depth.used, frame.frontier_cells,
                frame.void_cells, record.run.views.back().insert_ms);
  std::string lines = text;
  for (const TimedPlan& timed : frame.plans) {
    const std::string_view outcome = to_string(timed.plan.outcome);
    const double away_m = (timed.plan.goal.pose.translation() - pose.translation()).norm();
    std::snprintf(text, sizeof text, "    %-18s %-8.*s", timed.planner.c_str(), static_cast<int>(outcome.size()),
                  outcome.data());
    lines += text;
    if (timed.plan.outcome == Outcome::Move) {
      std::snprintf(text, sizeof text, " %5.2f m away, utility %-8.4g", away_m, timed.plan.goal.utility);
      lines += text;
    }
    std::snprintf(text, sizeof text, "  plan %7.1f ms\n", timed.plan_ms);
    lines += text;
  }
  return lines;
}

// Which axis was taken to point up, where the format says another.
std::string doubt_about_up(const ReplayRequest& request, const Recording& recording) {
  return !request.up.empty() || recording.up() == recording.up_of_format()
             ? ""
             : recording.up() +
                   " of the poses is up in the images and was taken to point up; if it does not, say so: "
                   "--up " +
                   recording.up_of_format() + '\n';
}

std::string doubt_about_camera(const Recording& recording) {
  return recording.assumed().empty() ? "" : recording.assumed() + "; if they are others, say so: --intrinsics\n";
}

void print_summary(std::ostream& out, const ReplayRecord& record, const Recording& recording, bool after_bar) {
  char text[128];
  std::snprintf(text, sizeof text, "%s\n  %-12s %zu, over a path of %.1f m\n", after_bar ? "\n" : "", "frames",
                record.frames.size(), record.run.path_length_m());
  out << text << "  outcome      " << to_string(record.run.outcome) << ": " << record.run.reason << '\n'
      << "  left out     " << record.skipped.size() << (record.skipped.size() == 1 ? " frame\n" : " frames\n");
  for (const SkippedFrame& frame : record.skipped) {
    out << "    " << frame.name << ": " << frame.reason << '\n';
  }
  if (recording.normalised() > 0) {
    out << "  normalised   " << recording.normalised() << " quaternions\n";
  }
}

void write_replay_outputs(const ReplayRequest& request, const ReplayRecord& record, const Recording& recording,
                          const OccupancyMap& map, const RunRecording& recorder, OutputFiles& files,
                          std::ostream& progress) {
  const std::string json = replay_json(record, recording, request.format);
  if (!request.run.out.empty()) {
    write_replay_files(request.run.out, record, json, map, recorder, files);
    tell_files(progress, files.written());
  }
  files.attempt([&] { give_json(request.run.json, json); });
  files.check();
}

void write_frame_sheet(const std::string& out, const ReplayRecord& record, const Recording& recording,
                       const RecordedReading& reading, const OccupancyMap& map, OutputFiles& files) {
  if (out.empty()) {
    return;
  }
  files.attempt([&] {
    const std::filesystem::path folder = std::filesystem::path(out) / "frames";
    make_folder(folder);
    write_png(frame_sheet(record, recording, reading, map),
              folder / (recording.frames()[record.frames.back().frame].name + ".png"));
  });
}

int replay(const ReplayRequest& request) {
  Interruption interruption;
  check_numbers(request);
  check_targets(request.run.out, request.run.json);
  const Recording recording = recording_of(request);
  // Whoever held the camera came closer to walls than a robot would, so the body alone must fit.
  const auto platform =
      std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = request.run.robot_radius_m, .margin_m = 0.0});
  auto planners = planners_of(request, recording.sensor(), platform);
  OccupancyMap map(map_options_of(request));
  ProgressStream told(request.run);
  std::ostream& progress = told.stream();
  progress << request.dataset << ": " << recording.frames().size() << " frames, cells of " << request.run.resolution_m
           << " m, range " << recording.camera().trusted_range_m() << " m\n"
           << doubt_about_up(request, recording) << doubt_about_camera(recording);
  if (request.select) {
    try {
      return select_views(request, recording, told);
    } catch (const std::invalid_argument& error) {  // what is in the recording, e.g. a pose far from all others
      throw std::invalid_argument("--dataset " + request.dataset + ": " + error.what());
    }
  }

  // The record and its page show the plans of the first planner.
  const std::unique_ptr<ExplorationPlanner> first = std::move(planners.front());
  RunRecorderSetup setup = recorder_setup(request.run, "replay", request.dataset, recording.sensor());
  setup.planner = first->name();
  planners.front() = std::make_unique<RunRecording>(*first, request.run.out, setup);
  auto& recorder = static_cast<RunRecording&>(*planners.front());
  const ReplaySpan span{.every = request.every, .max_views = request.run.max_views, .stop = [&interruption] {
                          return interruption.asked();
                        }};
  OutputFiles files;
  RunPrinter printer(progress, told.is_terminal(), {.count = frame_count(recording, span), .at_most = false});
  ReplayRecord record =
      apps::replay(recording, span, map, *platform, planners,
                   [&](const ReplayRecord& so_far, const RecordedReading& reading, const OccupancyMap& known) {
                     interruption.hold();
                     if (told.is_terminal()) {
                       printer.view(so_far.run.views.back());
                     } else {
                       progress << frame_line(so_far, recording, so_far.run.views.back().pose) << std::flush;
                     }
                     recorder.look(so_far.run.views.back(), known);
                     write_frame_sheet(request.run.out, so_far, recording, reading, known, files);
                   });
  if (map.bounds().empty() && !request.run.region.empty() && record.run.outcome != RunOutcome::Interrupted) {
    record.run.reason = "--region " + request.run.region + " holds nothing that a frame shows";
  }
  tell_request(record.run, request.run);
  record.run.command = "replay";
  record.run.world = request.dataset;
  record.run.planner = first->name();
  print_summary(progress, record, recording, told.is_terminal());
  recorder.finish(record.run);
  progress << recorder.cost(record.run);
  write_replay_outputs(request, record, recording, map, recorder, files, progress);
  return record.run.outcome == RunOutcome::Interrupted ? interruption.exit_code()
         : record.to_the_end                           ? kDone
                                                       : kBudget;
}

void add_recording_options(CLI::App& command, ReplayRequest& request) {
  std::string formats;
  for (const std::string_view format : Recording::formats()) {
    formats += (formats.empty() ? "" : "|") + std::string(format);
  }
  const auto option = [&](const char* name, auto& value, const std::string& type, const char* about) {
    return command.add_option(name, value, about)->type_name(type)->group("Recording");
  };
  option("--dataset", request.dataset, "DIR", "Folder of the recording; required")->required();
  option("--format", request.format, formats, "Layout of its files; required")->required();
  option("--every", request.every, "N", "Play only every Nth frame")->check(a_whole_number())->capture_default_str();
  option("--intrinsics", request.intrinsics, "fx,fy,cx,cy",
         "Intrinsics of the depth images, pixels, if the files have none");
  option("--max-range", request.max_range_m, "M", "Returns further than this only clear, metres; 0: by the format")
      ->check(a_number())
      ->capture_default_str();
  option("--disparities", request.disparities_px, "N",
         "Disparities of a stereo pair that count, pixels, a multiple of 16; surfaces nearer than these get no "
         "depth. Default: "
         "surfaces down to 4 baselines away")
      ->check(a_whole_number());
  option("--window", request.window_px, "N", "Edge of the matching window, pixels, odd; default: 5")
      ->check(a_whole_number());
  option("--up", request.up, "x|-x|y|-y|z|-z",
         "Axis of the poses that points up; default: the one that is up in the images");
  option("--region", request.run.region, "x0,y0,z0,x1,y1,z1", "Box to map, metres; default: all that is seen");
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("replay", "Map what a real camera recorded, and ask planners what they would do");
  const auto request = std::make_shared<ReplayRequest>();
  add_recording_options(*command, *request);
  CLI::Option* const planner =
      command->add_option("--planner", request->run.planner, "Names (vantage list), separated by commas")
          ->type_name("NAME,...")
          ->capture_default_str()
          ->group("Run");
  command->add_option("--robot-radius", request->run.robot_radius_m, "The robot is a sphere about its sensor, metres")
      ->type_name("M")
      ->check(a_number())
      ->capture_default_str()
      ->group("Run");
  command
      ->add_flag("--select", request->select,
                 "Compare orders of the recorded views by how soon they make cells known; without planners")
      ->excludes(planner)
      ->group("Run");
  command
      ->add_option("--object-box", request->object_box,
                   "With --select: box of an object, metres; only its cells count, the rest is known to be free")
      ->type_name("x0,y0,z0,x1,y1,z1")
      ->group("Run");
  add_setting_option(*command, request->run, "A setting of every planner named, as often as needed");
  add_run_options(*command, request->run);
  add_output_options(*command, request->run);
  command->footer(
      "Examples:\n"
      "  vantage replay --dataset rgbd_dataset_freiburg1_desk --format tum --out desk\n"
      "  vantage replay --dataset redkitchen --format 7scenes --select\n"
      "Exit codes: 0 the recording was played to its end, 2 bad input (nothing was written) or a file that cannot\n"
      "be written, 3 the views were spent, 130 and 143 interrupted.");
  command->callback([request, &exit_code] { exit_code = replay(*request); });
}

}  // namespace vantage::apps
