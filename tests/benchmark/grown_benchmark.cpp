// SPDX-License-Identifier: MIT
// plan/<planner>/grown/1, /15 and /100: a mine of 250 x 330 m with drifts of 4 x 3 m in cells of 0.2 m, of which so
// many per cent are known. One drift is open; before each plan it becomes known for another metre, and the robot
// follows. `survey_ms` is what it takes to bring the situation up to date; `choose_ms` and `path_ms` hold the field's
// solve and the paths, which follow the size of the reachable space.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr double kCellM = 0.2;
constexpr std::int32_t kLength = 1250;  // cells along x
constexpr std::int32_t kDepth = 1650;   // along y
constexpr std::int32_t kSpacing = 120;  // between drifts
constexpr std::int32_t kWidth = 20;
constexpr std::int32_t kHeight = 15;
constexpr std::int32_t kStep = 5;  // cells that become known before a plan
constexpr int kPlans = 12;

class Mine {
 public:
  explicit Mine(double share)
      : length_(static_cast<std::int32_t>(kLength * std::sqrt(share))),
        depth_(static_cast<std::int32_t>(kDepth * std::sqrt(share))) {
    std::vector<VoxelBox> drifts;
    for (std::int32_t y = 0; y < depth_; y += kSpacing) {
      drifts.push_back({{0, y, 0}, {length_, std::min(y + kWidth, depth_), kHeight}});
    }
    for (std::int32_t x = 0; x < length_; x += kSpacing) {
      drifts.push_back({{x, 0, 0}, {std::min(x + kWidth, length_), depth_, kHeight}});
    }
    for (const VoxelBox& drift : drifts) {
      map_.set_log_odds(drift.grown(1), 3.5);
    }
    for (const VoxelBox& drift : drifts) {
      map_.set_log_odds(drift, -2.0);
    }
    for_each_cell({{length_, 0, 0}, {length_ + 1, kWidth, kHeight}},
                  [&](const VoxelIndex& cell) { map_.set(cell, Occupancy::Unknown); });
  }

  // Another metre of the open drift.
  void reveal() {
    const VoxelBox more{{length_, 0, 0}, {length_ + kStep, kWidth, kHeight}};
    for_each_cell({{more.lo.x, -1, -1}, {more.hi.x, kWidth + 1, kHeight + 1}},
                  [&](const VoxelIndex& cell) { map_.set(cell, Occupancy::Occupied); });
    map_.set_log_odds(more, -2.0);
    length_ += kStep;
  }
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  // Two metres before the end of what is known.
  [[nodiscard]] Pose robot() const {
    return pose_looking(map_.frame().centre_of({length_ - 2 * kStep, kWidth / 2, kHeight / 2}), 0.0);
  }

 private:
  std::int32_t length_;
  std::int32_t depth_;
  OccupancyMap map_{{.resolution_m = kCellM}};
};

void plan_in_mine(benchmark::State& state, const std::string& name, double share) {
  Mine mine(share);
  const auto planner =
      make_planner(name, {.sensor = RangeSensor::preset("lidar"),
                          .platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.3})});
  (void)planner->plan(mine.map(), mine.robot());
  PlanStatistics sum;
  for (auto _ : state) {
    state.PauseTiming();
    mine.reveal();
    const Pose robot = mine.robot();
    state.ResumeTiming();
    const Plan plan = planner->plan(mine.map(), robot);
    sum.survey_ms += plan.statistics.survey_ms;
    sum.choose_ms += plan.statistics.choose_ms;
    sum.path_ms += plan.statistics.path_ms;
  }
  const OccupancyMap::Counts counts = mine.map().counts();
  state.counters["known"] = static_cast<double>(counts.free + counts.occupied);
  state.counters["survey_ms"] = sum.survey_ms / kPlans;
  state.counters["choose_ms"] = sum.choose_ms / kPlans;
  state.counters["path_ms"] = sum.path_ms / kPlans;
}

const bool registered = [] {
  for (const std::string_view planner : planner_names()) {
    for (const int percent : {1, 15, 100}) {
      const std::string name = "plan/" + std::string(planner) + "/grown/" + std::to_string(percent);
      benchmark::RegisterBenchmark(
          name.c_str(),
          [planner, percent](benchmark::State& state) { plan_in_mine(state, std::string(planner), percent / 100.0); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(kPlans);
    }
  }
  return true;
}();

}  // namespace
}  // namespace vantage
