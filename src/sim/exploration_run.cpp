// SPDX-License-Identifier: MIT
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/plan_check.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/view/candidate_views.hpp>

#include <vantage/geometry/impl/pose_distance.hpp>
#include <vantage/planner/impl/stopwatch.hpp>
#include <vantage/settings/impl/option_rule.hpp>
#include "report/full_map.hpp"
#include "sim/run_progress.hpp"
#include "sim/timed_robot.hpp"

namespace vantage {
namespace {

ExplorationRunOptions checked(ExplorationRunOptions options, const World& world) {
  detail::require_option(options.max_views > 0, "ExplorationRunOptions::max_views", options.max_views, "> 0");
  detail::require_option(options.max_path_m.value_or(1.0) > 0.0, "ExplorationRunOptions::max_path_m",
                         options.max_path_m.value_or(1.0), "> 0");
  detail::require_option(std::isfinite(options.scan_spacing_m) && options.scan_spacing_m >= 0.0,
                         "ExplorationRunOptions::scan_spacing_m", options.scan_spacing_m, ">= 0");
  detail::require_length(options.body_radius_m.value_or(0.0), "ExplorationRunOptions::body_radius_m");
  detail::require_option(options.threads > 0, "ExplorationRunOptions::threads", options.threads, "> 0");
  detail::require_option(std::isfinite(options.surface_gap_m) && options.surface_gap_m > 0.0,
                         "ExplorationRunOptions::surface_gap_m", options.surface_gap_m, "> 0");
  if (options.motion) {
    options.motion->validate();
  }
  if (options.band && options.unknown_box) {
    throw std::invalid_argument("ExplorationRunOptions::unknown_box: there is none in the plane of a band");
  }
  options.map.region = options.map.region.value_or(world.region);
  if (world.plan) {
    if (options.band) {
      throw std::invalid_argument("ExplorationRunOptions::band: a world that is a plane has no heights");
    }
    options.map.region->min.z() = 0.0;
    options.map.region->max.z() = options.map.resolution_m;
  }
  return options;
}

// In a band the map must hold the cells in which a floor may lie.
OccupancyMapOptions map_options_of(const ExplorationRunOptions& options) {
  OccupancyMapOptions map = options.map;
  if (options.band && options.band->needs_floor) {
    const double deepest_m = options.band->min_height_m - options.band->step_height_m;
    map.region->min.z() = std::min(map.region->min.z(), deepest_m - 2.0 * map.resolution_m);
  }
  return map;
}

Truth truth_of(const World& world, const RangeSensor& sensor, const ExplorationRunOptions& options) {
  const double around_m = sensor.reports_no_return ? Truth::kAroundM : std::max(Truth::kAroundM, sensor.max_range_m);
  Truth truth(world, options.map.resolution_m, *map_options_of(options).region, around_m);
  return options.band ? truth.in_band(*options.band) : truth;
}

Pose between(const Pose& from, const Pose& to, double share) {
  const Eigen::Quaterniond last(to.linear());
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(from.linear()).slerp(share, last).normalized().toRotationMatrix();
  pose.translation() = from.translation() + share * (to.translation() - from.translation());
  return pose;
}

double peak_memory_mb() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / 1024.0 : 0.0;
}

std::shared_ptr<const Platform> given(std::shared_ptr<const Platform> platform) {
  if (platform == nullptr) {
    throw std::invalid_argument("ExplorationRun needs a platform");
  }
  return platform;
}

}  // namespace

ExplorationRun::ExplorationRun(const World& world, const RangeSensor& sensor,
                               std::shared_ptr<const Platform> platform, const ExplorationRunOptions& options)
    : world_(world),
      sensor_(sensor),
      platform_(given(std::move(platform))),
      options_(checked(options, world)),
      scene_(world.mesh),
      truth_(truth_of(world, sensor, options_)),
      map_(map_options_of(options_)) {
  (void)SimulatedSensor(scene_, sensor, options_.noise);  // validates sensor and noise
}

void ExplorationRun::scan(Progress& progress) {
  const Scan scan = progress.sensor.scan(progress.pose);
  progress.surface.add(scan);
  progress.seen.add(progress.pose);
  detail::Stopwatch watch;
  const ScanReport report = map_.insert(scan, options_.ray_policy);
  if (band_) {
    band_->follow(map_);
  }
  ViewRecord view;
  view.insert_ms = watch.lap_ms();
  RunRecord& record = progress.record;
  if (!record.views.empty()) {
    view.frontier_cells = record.views.back().frontier_cells;
    view.void_cells = record.views.back().void_cells;
    view.utility = record.views.back().utility;
  }
  record.integration_operations += report.cells_hit + report.cells_cleared;
  view.view = record.views.size() + 1;
  view.pose = progress.pose;
  view.passed = std::exchange(progress.passed, {});
  view.path_length_m = progress.path_length_m;
  view.time_s = progress.time_s;
  if (options_.measure_coverage) {
    view.coverage = truth_.coverage(known(), progress.observable);
  }
  record.coverage = view.coverage;
  if (!options_.surface_samples.empty()) {
    view.surface_coverage = progress.surface.share();
    record.surface_coverage = view.surface_coverage;
  }
  if (!options_.object_surface.empty()) {
    view.seen_coverage = progress.seen.share();
    record.seen_coverage = view.seen_coverage;
  }
  record.views.push_back(view);
  progress.since_scan_m = 0.0;
}

// Turns once on the spot. Views overlap by a fifth. The last view is reported with the plan that follows.
void ExplorationRun::look_around(Progress& progress, detail::TimedRobot* robot, const OnView& on_view) {
  constexpr double kFullTurnRad = 2.0 * std::numbers::pi;
  const auto turns = static_cast<std::size_t>(std::ceil(kFullTurnRad / (0.8 * sensor_.horizontal_angle_rad())));
  const Pose start = progress.pose;
  for (std::size_t turn = 1; turn < turns && progress.record.views.size() < options_.max_views && !stopped();
       ++turn) {
    if (on_view) {
      on_view(progress.record.views.back(), known());
    }
    const double yaw_rad = kFullTurnRad * static_cast<double>(turn) / static_cast<double>(turns);
    Pose next = start;
    next.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * start.linear();
    if (robot == nullptr) {
      turn_to(progress, next);
      scan(progress);
    } else if (robot->follow(known(), {progress.pose, next})) {
      fly_on(progress, *robot, on_view);
    }
  }
}

void ExplorationRun::plan(Progress& progress, ExplorationPlanner& planner) {
  detail::Stopwatch watch;
  Plan& plan = progress.plan;
  plan = planner.plan(known(), progress.pose);
  ViewRecord& view = progress.record.views.back();
  view.plan_ms = watch.lap_ms();
  view.utility = plan.goal.utility;
  view.frontier_cells = plan.statistics.frontier_cells;
  view.void_cells = plan.statistics.void_cells;
  view.outcome = plan.outcome;
  progress.record.planning_operations += plan.statistics.ray_operations;
  progress.record.leftover = plan.leftover;
}

// In a band the body is a column of spheres over all heights of it.
bool ExplorationRun::collides(const Pose& from, const Pose& to, double radius_m) const {
  if (!options_.band) {
    return scene_.touches(from.translation(), to.translation(), radius_m);
  }
  const double lowest_m = options_.band->min_height_m + radius_m;
  const double highest_m = std::max(lowest_m, options_.band->max_height_m - radius_m);
  const double step_m = std::max(radius_m, map_.resolution_m());
  const auto steps = static_cast<int>(std::ceil((highest_m - lowest_m) / step_m));
  for (int step = 0; step <= steps; ++step) {
    Eigen::Vector3d a = from.translation();
    Eigen::Vector3d b = to.translation();
    a.z() = b.z() = std::min(lowest_m + step * step_m, highest_m);
    if (scene_.touches(a, b, radius_m)) {
      return true;
    }
  }
  return false;
}

void ExplorationRun::turn_to(Progress& progress, const Pose& to) {
  const Eigen::Quaterniond by(Eigen::Matrix3d(progress.pose.linear().transpose() * to.linear()));
  progress.record.turned_deg += 2.0 * std::atan2(by.vec().norm(), std::abs(by.w())) * 180.0 / std::numbers::pi;
  progress.pose = to;
}

void ExplorationRun::move(Progress& progress, const Pose& to) {
  const double length_m = (to.translation() - progress.pose.translation()).norm();
  if (length_m > 0.0) {
    progress.record.collisions += collides(progress.pose, to, progress.body_radius_m) ? 1U : 0U;
    progress.record.travelled.push_back(to.translation());
    progress.passed.push_back(to.translation());
  }
  progress.path_length_m += length_m;
  progress.since_scan_m += length_m;
  turn_to(progress, to);
}

// Follows the path to the goal, or until `check` is not Good, the budget is spent or somebody stops the run. The
// last scan is reported with the plan that follows.
void ExplorationRun::follow(Progress& progress, const OnView& on_view) {
  const Plan& plan = progress.plan;
  for (std::size_t next = 1; next < plan.path.size(); ++next) {
    const Pose from = progress.pose;
    const Pose& to = plan.path[next];
    const double length_m = (to.translation() - from.translation()).norm();
    double done_m = 0.0;
    while (options_.scan_spacing_m > 0.0 && done_m + options_.scan_spacing_m - progress.since_scan_m < length_m) {
      done_m += options_.scan_spacing_m - progress.since_scan_m;
      move(progress, between(from, to, done_m / length_m));
      scan(progress);
      const bool spent = progress.record.views.size() >= options_.max_views;
      if (spent || stopped() || check(plan, known(), *platform_, progress.pose) != PlanCheck::Good) {
        return;
      }
      if (on_view) {
        on_view(progress.record.views.back(), known());
      }
    }
    move(progress, to);
  }
  scan(progress);
}

// Looks from the lattice of the coverage and, because an object is small compared with it, from shells around the
// object.
void ExplorationRun::measure_observable(Progress& progress, const Pose& start) const {
  if (options_.object_surface.empty()) {
    return;
  }
  std::vector<Eigen::Vector3d> places;
  for (const VoxelIndex& cell : truth_.lattice(*platform_, start)) {
    places.push_back(map_.frame().centre_of(cell));
  }
  Box box;
  for (const SurfaceSample& sample : options_.object_surface) {
    box.extend(sample.point);
  }
  const double reach_m = 0.5 * box.extent().norm();
  for (const Pose& view : views_around(box.centre(), std::vector{1.1 * reach_m, 1.5 * reach_m, 2.5 * reach_m})) {
    if (platform_->admits(truth_.map(), view)) {
      places.push_back(view.translation());
    }
  }
  const std::size_t observable = progress.seen.observable_count(*platform_, places);
  progress.record.seen_observable =
      observable == 0 ? 1.0 : static_cast<double>(progress.seen.seen_count()) / static_cast<double>(observable);
}

// Plans, and tells of the latest scan. False where that ends the run.
bool ExplorationRun::goes_on(Progress& progress, ExplorationPlanner& planner, const OnView& on_view) {
  RunRecord& record = progress.record;
  const bool planned = !stopped();
  if (planned) {
    plan(progress, planner);
  }
  if (on_view) {
    on_view(record.views.back(), known());
  }
  const Plan& next = progress.plan;
  const auto end_as = [&](RunOutcome outcome, std::string reason) {
    record.outcome = outcome;
    record.reason = std::move(reason);
    return false;
  };
  if (!planned || (next.outcome == Outcome::Move && stopped())) {
    return end_as(RunOutcome::Interrupted, "interrupted after view " + std::to_string(record.views.size()));
  }
  if (next.outcome != Outcome::Move || next.path.empty()) {
    return end_as(run_outcome_of(next.outcome), next.reason);
  }
  if (record.views.size() >= options_.max_views) {
    return end_as(RunOutcome::Budget, "the budget of " + std::to_string(options_.max_views) + " views is spent");
  }
  if (options_.max_path_m && progress.path_length_m + detail::length_m(next.path) > *options_.max_path_m) {
    char reason[96];
    std::snprintf(reason, sizeof reason, "the next view is out of the budget of %g m of path", *options_.max_path_m);
    return end_as(RunOutcome::Budget, reason);
  }
  return true;
}

RunRecord ExplorationRun::run(ExplorationPlanner& planner, const Pose& start, const OnView& on_view) {
  check_start(start);
  map_ = OccupancyMap(map_.options());
  if (options_.band) {
    band_.emplace(map_.options(), *options_.band);
  }
  Progress progress(start, SimulatedSensor(scene_, sensor_, options_.noise, options_.seed),
                    SurfaceCoverage(options_.surface_samples, options_.surface_gap_m),
                    SeenSurface(scene_, options_.object_surface, sensor_));
  if (options_.measure_coverage) {
    if (!observable_from_ || observable_from_->matrix() != start.matrix()) {
      observable_ = truth_.observable(*platform_, sensor_, start, options_.threads, options_.on_observable_share,
                                      options_.unknown_box);
      observable_from_ = start;
    }
    progress.observable = observable_;
  }
  progress.body_radius_m = options_.body_radius_m.value_or(0.5 * platform_->body_box(start).extent().minCoeff());
  RunRecord& record = progress.record;
  record.command = "explore";
  record.world = world_.name;
  record.planner = std::string(planner.name());
  record.seed = options_.seed;
  record.threads = options_.threads;
  record.resolution_m = map_.resolution_m();
  record.observable_cells = progress.observable.size();
  record.travelled.push_back(start.translation());
  if (options_.unknown_box) {
    truth_.tell_around(*options_.unknown_box, map_);
  }
  assume_start_free(start);
  for (const Box& box : options_.declared_clear) {
    map_.assume_free(box);
  }
  if (options_.motion) {
    fly(progress, planner, on_view);
  } else {
    scan(progress);
    if (options_.look_around) {
      look_around(progress, nullptr, on_view);
    }
    while (goes_on(progress, planner, on_view)) {
      follow(progress, on_view);
    }
  }
  measure_observable(progress, start);
  detail::tell_refused(record, map_);
  record.peak_memory_mb = peak_memory_mb();
  return std::move(progress.record);
}

}  // namespace vantage
