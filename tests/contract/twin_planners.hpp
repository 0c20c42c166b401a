// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vantage/evaluation/exploration_peers.hpp>
#include <vantage/planner/make_planner.hpp>

namespace vantage::testing {

/// Whether two plans ask for the same.
[[nodiscard]] inline bool are_same(const Plan& a, const Plan& b) {
  return a.outcome == b.outcome && a.leftover == b.leftover && a.goal.pose.matrix() == b.goal.pose.matrix() &&
         a.goal.utility == b.goal.utility && a.sought == b.sought && a.path.size() == b.path.size() &&
         std::equal(a.path.begin(), a.path.end(), b.path.begin(),
                    [](const Pose& p, const Pose& q) { return p.matrix() == q.matrix(); });
}

/// A planner, or a peer of that name.
[[nodiscard]] inline std::unique_ptr<ExplorationPlanner> planner_named(const std::string& name,
                                                                       const PlannerSetup& setup) {
  const auto peers = exploration_peer_names();
  return std::find(peers.begin(), peers.end(), name) != peers.end() ? make_exploration_peer(name, setup)
                                                                    : make_planner(name, setup);
}

/// A planner on one thread, and its twin on two.
class TwinPlanners {
 public:
  TwinPlanners(const std::string& name, PlannerSetup setup) {
    setup.threads = 1;
    one_ = planner_named(name, setup);
    setup.threads = 2;
    on_threads_ = planner_named(name, setup);
  }

  [[nodiscard]] Plan plan(const OccupancyMap& map, const Pose& current) { return one_->plan(map, current); }
  /// Whether the twin makes the same plan.
  [[nodiscard]] bool agree_on(const Plan& plan, const OccupancyMap& map, const Pose& current) {
    return are_same(plan, on_threads_->plan(map, current));
  }
  void report(const OccupancyMap& map, const Pose& current, GoalResult result) { one_->report(map, current, result); }
  [[nodiscard]] std::string memory() const { return one_->memory(); }
  void recall(const OccupancyMap& map, const std::string& memory) {
    one_->recall(map, memory);
    on_threads_->recall(map, memory);
  }

 private:
  std::unique_ptr<ExplorationPlanner> one_;
  std::unique_ptr<ExplorationPlanner> on_threads_;
};

}  // namespace vantage::testing
