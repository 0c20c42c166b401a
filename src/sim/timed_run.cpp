// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <utility>
#include <vantage/planner/plan_check.hpp>
#include <vantage/sim/exploration_run.hpp>

#include "sim/run_progress.hpp"
#include "sim/timed_robot.hpp"

namespace vantage {
namespace {

// The n-th scan after the first. Not a sum of intervals: that would drift.
double scan_time_s(const MotionModel& motion, std::size_t n) { return static_cast<double>(n) / motion.scan_rate_hz; }

std::size_t unknown_in(const OccupancyMap& map, const std::vector<VoxelIndex>& cells) {
  return static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](const VoxelIndex& cell) { return map.at(cell) == Occupancy::Unknown; }));
}

}  // namespace

// However often the body touches something between two scans, that is one collision.
void ExplorationRun::fly_until(Progress& progress, detail::TimedRobot& robot, double time_s) {
  const std::size_t collisions = progress.record.collisions;
  robot.advance(time_s, [&](const Pose& pose) { move(progress, pose); });
  progress.record.collisions = std::min(progress.record.collisions, collisions + 1);
}

void ExplorationRun::scan_in_time(Progress& progress, const detail::TimedRobot& robot) {
  progress.time_s = robot.time_s();
  const std::vector<VoxelIndex>& sought = progress.plan.sought;
  const std::size_t unknown = unknown_in(known(), sought);
  const OccupancyMap::Revision before = known().revision();
  scan(progress);
  const bool taught = sought.empty() ? !known().changed_since(before).empty() : unknown_in(known(), sought) < unknown;
  if (taught) {
    progress.record.duration_s = progress.time_s;
  }
}

// To the end of its path, without a plan. The last scan is left to be reported with the plan that comes of it.
void ExplorationRun::fly_on(Progress& progress, detail::TimedRobot& robot, const OnView& on_view) {
  bool first = true;
  do {
    if (!std::exchange(first, false) && on_view) {
      on_view(progress.record.views.back(), known());
    }
    fly_until(progress, robot, scan_time_s(*options_.motion, progress.record.views.size()));
    scan_in_time(progress, robot);
  } while (!robot.has_arrived() && progress.record.views.size() < options_.max_views && !stopped());
}

void ExplorationRun::fly(Progress& progress, ExplorationPlanner& planner, const OnView& on_view) {
  const MotionModel& motion = *options_.motion;
  detail::TimedRobot robot(platform_, motion, progress.pose);
  scan_in_time(progress, robot);
  if (options_.look_around) {
    look_around(progress, &robot, on_view);
  }
  constexpr double kNoPlanDue = std::numeric_limits<double>::infinity();
  bool follows = false;              // the latest plan ...
  double follows_at_s = kNoPlanDue;  // ... or will from then on
  for (;;) {
    const bool free = robot.way_is_free(known());
    if (!free) {
      robot.brake(known());
    }
    const bool goes_well = follows && free && !robot.has_arrived() &&
                           check(progress.plan, known(), *platform_, progress.pose) != PlanCheck::NothingLeft;
    const bool ends = stopped() || progress.record.views.size() >= options_.max_views;
    if (ends || (follows_at_s == kNoPlanDue && !goes_well)) {
      if (!goes_on(progress, planner, on_view)) {
        return;
      }
      follows = false;
      follows_at_s = robot.time_s() + motion.planning_latency_s;
    } else if (on_view) {
      on_view(progress.record.views.back(), known());
    }
    const double next_s = scan_time_s(motion, progress.record.views.size());
    if (follows_at_s <= next_s) {
      fly_until(progress, robot, follows_at_s);
      follows = robot.follow(known(), progress.plan.path);
      if (!follows) {  // it plans again where it comes to rest, at the latest
        robot.brake(known());
      }
      follows_at_s = kNoPlanDue;
    }
    fly_until(progress, robot, next_s);
    scan_in_time(progress, robot);
  }
}

}  // namespace vantage
