// SPDX-License-Identifier: MIT
// How does a researcher add a planner and compare it? A FrontierPlanner contains everything but the choice of the
// next view; ExplorationRun drives it through a known world and measures it.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <vantage/planner/frontier_planner.hpp>
#include <vantage/sim/exploration_run.hpp>
#include <vantage/vantage.hpp>
#include <vector>

// Goes to the largest cluster of frontier cells of which a target is left.
class LargestClusterPlanner final : public vantage::FrontierPlanner {
 public:
  using FrontierPlanner::FrontierPlanner;
  [[nodiscard]] std::string_view name() const override { return "largest-cluster"; }

 protected:
  [[nodiscard]] vantage::Choice choose(const vantage::Situation& situation) override {
    const std::vector<vantage::FrontierTarget>& targets = situation.survey().targets;
    std::vector<vantage::VoxelIndex> cells;
    for (const vantage::FrontierTarget& target : targets) {
      cells.push_back(target.frontier);
    }
    const auto clusters = vantage::frontier_clusters(cells);
    const auto& largest = *std::max_element(clusters.begin(), clusters.end(),
                                            [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const auto target = std::find_if(targets.begin(), targets.end(), [&](const vantage::FrontierTarget& one) {
      return one.frontier == largest[largest.size() / 2];
    });
    vantage::Choice choice;
    choice.view = view_of_target(situation.surveyed(), *target, choice.statistics.ray_operations);
    return choice;
  }
};

int main() {
  const auto robot = std::make_shared<vantage::FreeFlyer>(vantage::FreeFlyerOptions{.radius_m = 0.2});
  const vantage::PlannerSetup setup{.sensor = vantage::RangeSensor::preset("panoramic"), .platform = robot};
  vantage::ExplorationRun run(vantage::World::by_name("maze"), setup.sensor, robot, {.map = {.resolution_m = 0.2}});
  LargestClusterPlanner mine(setup);
  const auto nearest = vantage::make_planner("nearest-frontier", setup);
  for (vantage::ExplorationPlanner* planner : {static_cast<vantage::ExplorationPlanner*>(&mine), nearest.get()}) {
    const vantage::RunRecord record = run.run(*planner, vantage::pose_looking({0.9, 0.9, 1.0}, 0.0));
    std::cout << planner->name() << ": " << to_string(record.outcome) << " after " << record.path_length_m()
              << " m and " << record.views.size() << " views, coverage " << record.coverage.value_or(0.0) << '\n';
  }
}
