// SPDX-License-Identifier: MIT
#include "apps/replay_run.hpp"

#include <sys/resource.h>

#include <chrono>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/report/report_json.hpp>

#include "report/full_map.hpp"

namespace vantage::apps {
namespace {

using Json = nlohmann::ordered_json;

template <class Call>
double milliseconds_of(Call&& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::size_t first_out_of_use(const Recording& recording, const ReplaySpan& span) {
  return std::min(recording.frames().size(), span.every * span.max_views);
}

// An error in a file of poses must not make a map of that size.
void check_place(const Pose& pose) {
  constexpr double kFurthestM = 1e5;
  if (!(pose.translation().cwiseAbs().maxCoeff() <= kFurthestM)) {
    std::ostringstream message;
    message << "its pose is at " << pose.translation().x() << ", " << pose.translation().y() << ", "
            << pose.translation().z() << " m, must be within " << kFurthestM << " m either way";
    throw std::runtime_error(message.str());
  }
}

void ask_planners(ReplayedFrame& frame, const OccupancyMap& map, const Pose& pose,
                  const std::vector<std::unique_ptr<ExplorationPlanner>>& planners) {
  for (const auto& planner : planners) {
    TimedPlan& timed = frame.plans.emplace_back();
    timed.planner = planner->name();
    timed.plan_ms = milliseconds_of([&] { timed.plan = planner->plan(map, pose); });
  }
}

void add_view(RunRecord& run, const ReplayedFrame& frame, const Pose& pose, double insert_ms) {
  const double step_m = run.travelled.empty() ? 0.0 : (pose.translation() - run.travelled.back()).norm();
  const TimedPlan& first = frame.plans.front();
  ViewRecord view;
  view.view = run.views.size() + 1;
  view.pose = pose;
  view.path_length_m = run.path_length_m() + step_m;
  view.insert_ms = insert_ms;
  view.plan_ms = first.plan_ms;
  view.utility = first.plan.goal.utility;
  view.frontier_cells = frame.frontier_cells;
  view.void_cells = frame.void_cells;
  view.outcome = first.plan.outcome;
  view.passed = {pose.translation()};
  run.views.push_back(view);
  run.travelled.push_back(pose.translation());
  run.integration_operations += frame.scan.cells_hit + frame.scan.cells_cleared;
  run.planning_operations += first.plan.statistics.ray_operations;
}

void conclude(ReplayRecord& record, bool stopped) {
  const Plan& last = record.frames.back().plans.front().plan;
  RunRecord& run = record.run;
  run.leftover = last.leftover;
  if (stopped) {
    record.to_the_end = false;
    run.outcome = RunOutcome::Interrupted;
    run.reason = "interrupted after frame " + std::to_string(record.frames.size());
  } else {
    run.outcome = run_outcome_of(last.outcome);
    run.reason = last.outcome != Outcome::Move
                     ? last.reason
                     : std::string(record.to_the_end ? "the recording is at its end" : "the views were spent") +
                           "; the planner would go on: " + last.reason;
  }
  rusage usage{};
  run.peak_memory_mb = getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / 1024.0 : 0.0;
}

Json json_of(const Pose& pose) {
  Eigen::Quaterniond q(pose.linear());
  q.coeffs() *= q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d& p = pose.translation();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

Json json_of(const TimedPlan& timed) {
  const Plan& plan = timed.plan;
  return {{"planner", timed.planner},
          {"outcome", to_string(plan.outcome)},
          {"reason", plan.reason},
          {"goal", plan.outcome == Outcome::Move ? json_of(plan.goal.pose) : Json()},
          {"utility", plan.goal.utility},
          {"plan_ms", timed.plan_ms},
          {"frontier_cells", plan.statistics.frontier_cells},
          {"observable_cells", plan.statistics.observable_cells},
          {"reachable_cells", plan.statistics.reachable_cells}};
}

}  // namespace

std::size_t frame_count(const Recording& recording, const ReplaySpan& span) {
  return (first_out_of_use(recording, span) + span.every - 1) / span.every;
}

ReplayRecord replay(const Recording& recording, const ReplaySpan& span, OccupancyMap& map, const Platform& platform,
                    const std::vector<std::unique_ptr<ExplorationPlanner>>& planners, const OnFrame& on_frame) {
  ReplayRecord record;
  record.skipped = recording.skipped();
  const std::size_t end = first_out_of_use(recording, span);
  record.to_the_end = end == recording.frames().size();
  bool stopped = false;
  for (std::size_t i = 0; i < end && !stopped; i += span.every) {
    const Pose pose = recording.pose(i);
    RecordedReading reading;
    ReplayedFrame frame;
    frame.frame = i;
    double insert_ms = 0.0;
    try {
      check_place(pose);
      reading = recording.read(i);
      map.assume_free(platform.body_box(pose));
      insert_ms = milliseconds_of([&] { frame.scan = map.insert(reading.scan.scan); });
    } catch (const std::bad_alloc&) {
      throw;  // out of memory: the next frame would find no more
    } catch (const std::exception& error) {
      record.skipped.push_back({recording.frames()[i].name, error.what()});
      continue;
    }
    frame.depth = reading.scan.report;
    const OccupancyMap::Counts counts = map.counts();
    frame.free_cells = counts.free;
    frame.occupied_cells = counts.occupied;
    frame.frontier_cells = count_frontier_cells(map);
    frame.void_cells = count_void_cells(map);
    ask_planners(frame, map, pose, planners);
    add_view(record.run, frame, pose, insert_ms);
    record.frames.push_back(std::move(frame));
    on_frame(record, reading, map);
    stopped = span.stop && span.stop();
  }
  if (record.frames.empty()) {
    const SkippedFrame& last = record.skipped.back();
    throw std::runtime_error("--dataset: no frame can be used; the last, " + last.name + ": " + last.reason);
  }
  conclude(record, stopped);
  detail::tell_refused(record.run, map);
  return record;
}

std::string replay_json(const ReplayRecord& record, const Recording& recording, const std::string& format) {
  Json frames = Json::array();
  for (const ReplayedFrame& frame : record.frames) {
    Json plans = Json::array();
    for (const TimedPlan& timed : frame.plans) {
      plans.push_back(json_of(timed));
    }
    frames.push_back({{"frame", recording.frames()[frame.frame].name},
                      {"pixels_used", frame.depth.used},
                      {"pixels_not_measured", frame.depth.not_measured},
                      {"pixels_flying", frame.depth.flying},
                      {"free_cells", frame.free_cells},
                      {"occupied_cells", frame.occupied_cells},
                      {"frontier_cells", frame.frontier_cells},
                      {"void_cells", frame.void_cells},
                      {"plans", std::move(plans)}});
  }
  Json skipped = Json::array();
  for (const SkippedFrame& frame : record.skipped) {
    skipped.push_back({{"frame", frame.name}, {"reason", frame.reason}});
  }
  Json replay = {{"format", format},
                 {"quaternions_normalised", recording.normalised()},
                 {"skipped", std::move(skipped)},
                 {"frames", std::move(frames)}};
  const std::string report = report_json(record.run);
  const std::size_t end = report.find_last_of('}');
  return report.substr(0, report.find_last_not_of(" \n", end - 1) + 1) +
         ",\n  \"replay\": " + replay.dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n}\n";  // names may be no UTF-8
}

}  // namespace vantage::apps
