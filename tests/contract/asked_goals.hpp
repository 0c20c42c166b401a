// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vantage/planner/exploration_planner.hpp>
#include <vector>

#include <vantage/geometry/impl/pose_distance.hpp>

namespace vantage::testing {

/// Counts how often in a row a planner asks for the same goal without progress.
class AskedGoals {
 public:
  /// A plan that moves the robot from `pose`.
  void count(const Plan& plan, const Pose& pose, const OccupancyMap& map) {
    const VoxelFrame& frame = map.frame();
    // A robot that stands at its goal, or beside it, comes no nearer. It may be asked to look from there for other
    // cells: beside it, if it saw all that was sought before.
    const bool may_look_again = (goal_.translation() - pose.translation()).norm() < 0.5 * frame.size_m ||
                                std::none_of(sought_.begin(), sought_.end(), [&](const VoxelIndex& cell) {
                                  return map.at(cell) == Occupancy::Unknown;
                                });
    const bool for_others = std::none_of(plan.sought.begin(), plan.sought.end(), [&](const VoxelIndex& cell) {
      return std::find(sought_.begin(), sought_.end(), cell) != sought_.end();
    });
    const double way_m = detail::length_m(plan.path);
    const double turn = detail::angle_rad(pose, plan.goal.pose);
    const bool same = frame.cell_of(plan.goal.pose.translation()) == frame.cell_of(goal_.translation()) &&
                      detail::angle_rad(goal_, plan.goal.pose) < 0.1;
    const bool no_nearer = way_m > way_m_ - 0.01 && (way_m > 0.01 || turn > turn_rad_ - 0.01);
    const bool again = same && no_nearer && !(may_look_again && for_others);
    in_a_row_ = again ? in_a_row_ + 1 : 1;
    most_ = std::max(most_, in_a_row_);
    goal_ = plan.goal.pose;
    sought_ = plan.sought;
    way_m_ = again ? std::min(way_m, way_m_) : way_m;
    turn_rad_ = again ? std::min(turn, turn_rad_) : turn;
  }
  /// What is asked for next has a reason.
  void begin_again() { in_a_row_ = 0; }
  /// The longest series of plans for one goal without progress.
  [[nodiscard]] std::size_t most() const { return most_; }

 private:
  Pose goal_ = Pose::Identity();
  std::vector<VoxelIndex> sought_;
  double way_m_ = 0.0;
  double turn_rad_ = 0.0;
  std::size_t in_a_row_ = 0;
  std::size_t most_ = 0;
};

}  // namespace vantage::testing
