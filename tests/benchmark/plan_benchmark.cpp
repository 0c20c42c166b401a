// SPDX-License-Identifier: MIT
// plan/<planner>/rooms: a whole plan, from the map's frontier to the way there, after every scan of one and the same
// run of `harmonic` through the paper's world; `frontier-gain` weighs 200 hypotheses. Operations are cells visited
// along rays plus cell updates of the field.
#include <benchmark/benchmark.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr double kCellM = 0.2;
constexpr std::size_t kMostScans = 100;
constexpr benchmark::IterationCount kPlans = 60;  // about three runs

// What a sensor measured on its way, and the place from which it left.
struct RoomsRun {
  World world = World::by_name("rooms");
  RangeSensor sensor = RangeSensor::preset("panoramic");
  std::shared_ptr<const Platform> robot = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15});
  Pose start = Pose::Identity();
  std::vector<Scan> scans;

  [[nodiscard]] OccupancyMap map_at_start() const {
    OccupancyMap map({.resolution_m = kCellM, .region = world.region});
    map.assume_free(robot->body_box(start));
    return map;
  }
  [[nodiscard]] PlannerSetup setup() const { return {.sensor = sensor, .platform = robot}; }
};

// Scans at goals only, until all is explored.
RoomsRun explore_rooms() {
  RoomsRun run;
  const std::optional<Pose> start = Truth(run.world, kCellM, run.world.region).draw_start(*run.robot, 1);
  if (!start) {
    throw std::runtime_error("rooms: the robot fits nowhere");
  }
  run.start = *start;
  SimulatedSensor sensor(TriangleScene(run.world.mesh), run.sensor);
  OccupancyMap map = run.map_at_start();
  const auto planner = make_planner("harmonic", run.setup());
  Pose pose = run.start;
  while (run.scans.size() < kMostScans) {
    run.scans.push_back(sensor.scan(pose));
    map.insert(run.scans.back());
    const Plan plan = planner->plan(map, pose);
    if (plan.outcome != Outcome::Move) {
      run.scans.pop_back();  // its plan only says that all is done
      break;
    }
    pose = plan.path.back();
  }
  return run;
}

const RoomsRun& rooms_run() {
  static const RoomsRun run = explore_rooms();
  return run;
}

void plan_in_rooms(benchmark::State& state, const std::string& name, const PlannerSettings& settings) {
  const RoomsRun& run = rooms_run();
  PlanStatistics sum;
  std::size_t plans = 0;
  std::size_t next = run.scans.size();
  std::optional<OccupancyMap> map;
  std::unique_ptr<ExplorationPlanner> planner;
  for (auto _ : state) {
    state.PauseTiming();
    if (next == run.scans.size()) {
      next = 0;
      map.emplace(run.map_at_start());
      planner = make_planner(name, run.setup(), settings);
    }
    const Scan& scan = run.scans[next++];
    map->insert(scan);
    state.ResumeTiming();
    const Plan plan = planner->plan(*map, scan.world_from_sensor);
    ++plans;
    sum.ray_operations += plan.statistics.ray_operations;
    sum.survey_ms += plan.statistics.survey_ms;
    sum.choose_ms += plan.statistics.choose_ms;
    sum.path_ms += plan.statistics.path_ms;
  }
  const auto mean = [&](double total) { return total / static_cast<double>(plans); };
  state.counters["plans_a_run"] = static_cast<double>(run.scans.size());
  state.counters["operations"] = mean(static_cast<double>(sum.ray_operations));
  state.counters["survey_ms"] = mean(sum.survey_ms);
  state.counters["choose_ms"] = mean(sum.choose_ms);
  state.counters["path_ms"] = mean(sum.path_ms);
}

const bool registered = [] {
  const auto add = [](const std::string& name, const PlannerSettings& settings) {
    benchmark::RegisterBenchmark(("plan/" + name + "/rooms").c_str(),
                                 [name, settings](benchmark::State& state) { plan_in_rooms(state, name, settings); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(kPlans);
  };
  add("harmonic", {});
  add("frontier-gain", {{"hypotheses", "200"}});
  return true;
}();

}  // namespace
}  // namespace vantage
