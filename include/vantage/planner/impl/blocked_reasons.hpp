// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vantage/planner/exploration_planner.hpp>
#include <vantage/robot/platform.hpp>
#include <vantage/view/tried_views.hpp>
#include <vector>

namespace vantage::detail {

inline constexpr const char* kDoesNotMove =
    "the robot does not move: it is where it was when several goals were asked for, each more than once; "
    "free it, or plan again after a while, which asks for them again";
inline constexpr const char* kIsNotAdmitted =
    "the platform does not admit the place where it is, and there is no free place beside it: move it into "
    "known free space, or declare the space around it free (assume_free)";
inline constexpr const char* kNoViewIsAdmitted =
    "the platform admits none of the candidate views: declare the space around the object free (assume_free)";

inline std::string counted(std::size_t count, const char* what) { return std::to_string(count) + " " + what; }

inline constexpr double kRefusedRad = std::numbers::pi / 3.0;

/// Whether the straight line from a robot at `from` to a place is off all refused directions by this angle.
inline bool leads_elsewhere(const std::vector<Eigen::Vector3d>& refused, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to, double angle_rad = kRefusedRad) {
  const Eigen::Vector3d line = to - from;
  const double least = std::cos(angle_rad) * line.norm();
  return std::all_of(refused.begin(), refused.end(),
                     [&](const Eigen::Vector3d& direction) { return line.dot(direction) <= least; });
}

/// The refused directions of a robot that does not move, otherwise none.
inline std::vector<Eigen::Vector3d> refused_by_a_stuck_robot(const TriedViews& tried, const Pose& current) {
  return tried.is_stuck(current) ? tried.refused_directions(current) : std::vector<Eigen::Vector3d>();
}

/// Outcome and reason of a plan for an object if no path leads to any view that would show more.
inline void end_without_a_path(const OccupancyMap& map, const Platform& platform, const Pose& current,
                               TriedViews& tried, Plan& plan) {
  const std::size_t places = tried.places_given_up();
  plan.outcome = Outcome::Blocked;
  if (tried.is_stuck(current)) {
    plan.reason = kDoesNotMove;
  } else if (!platform.admits(map, current)) {
    plan.reason = kIsNotAdmitted;
  } else {
    plan.outcome = Outcome::Unreachable;
    plan.reason = places > 0 ? "the robot does not get to " + counted(places, "places that show more of the object")
                             : "there is no path to any view that would show more of the object";
  }
  tried.end_run();
}

}  // namespace vantage::detail
