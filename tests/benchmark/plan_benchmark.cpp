// SPDX-License-Identifier: MIT
// plan/<planner>/rooms: a complete plan (frontier to path) after every scan of the same run of `harmonic` in the
// world of the paper; `frontier-gain` evaluates 200 hypotheses. Operations are cells visited along rays plus cell
// updates of the field.
//
// plan/<planner>/rooms-stereo: the same with a narrow sensor, after every scan of the planner's own complete run.
//
// plan/<planner>/rooms-level: that with a robot that cannot tilt this sensor, in cells of 0.1 m.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <numbers>
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

// The scans of a run, and its start.
struct RoomsRun {
  World world = World::by_name("rooms");
  RangeSensor sensor;
  std::shared_ptr<const Platform> robot;
  double cell_m = 0.0;
  Pose start = Pose::Identity();
  std::vector<Scan> scans;

  [[nodiscard]] OccupancyMap map_at_start() const {
    OccupancyMap map({.resolution_m = cell_m, .region = world.region});
    map.assume_free(robot->body_box(start));
    return map;
  }
  [[nodiscard]] PlannerSetup setup() const { return {.sensor = sensor, .platform = robot}; }
};

// The preset `stereo` with every fourth column and row: rays are 5 cm apart at the maximum range.
RangeSensor thin_stereo() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  return RangeSensor::pinhole(128, 96, 65.0 * kDegree, 51.0771935 * kDegree, 0.5, 5.0);
}

// A benchmark case: planner, run and the maximum number of scans.
struct PlanCase {
  std::string planner;
  Settings settings = {};
  std::string explorer = "harmonic";  // planner of the run
  RangeSensor sensor = RangeSensor::preset("panoramic");
  std::size_t most_scans = 100;
  benchmark::IterationCount plans = 60;
  bool is_level = false;
  double cell_m = 0.2;
};

// Scans at goals only, until all is explored or the limit is reached.
RoomsRun explore_rooms(const PlanCase& what) {
  RoomsRun run;
  run.sensor = what.sensor;
  run.cell_m = what.cell_m;
  run.robot = std::make_shared<const FreeFlyer>(
      FreeFlyerOptions{.radius_m = 0.15, .margin_m = 0.0, .yaw_only = what.is_level});
  const std::optional<Pose> start = Truth(run.world, run.cell_m, run.world.region).draw_start(*run.robot, 1);
  if (!start) {
    throw std::runtime_error("rooms: the robot fits nowhere");
  }
  run.start = *start;
  SimulatedSensor sensor(TriangleScene(run.world.mesh), run.sensor);
  OccupancyMap map = run.map_at_start();
  const auto planner =
      make_planner(what.explorer, run.setup(), what.explorer == what.planner ? what.settings : Settings{});
  Pose pose = run.start;
  while (run.scans.size() < what.most_scans) {
    run.scans.push_back(sensor.scan(pose));
    map.insert(run.scans.back());
    const Plan plan = planner->plan(map, pose);
    if (plan.outcome != Outcome::Move) {
      run.scans.pop_back();  // its plan only reports the end
      break;
    }
    pose = plan.path.back();
  }
  return run;
}

const RoomsRun& rooms_run(const PlanCase& what, const std::string& scene) {
  static std::map<std::string, RoomsRun> runs;
  const std::string key = scene + "/" + what.explorer;
  const auto known = runs.find(key);
  return known != runs.end() ? known->second : runs.emplace(key, explore_rooms(what)).first->second;
}

void plan_in_rooms(benchmark::State& state, const std::string& scene, const PlanCase& what) {
  const RoomsRun& run = rooms_run(what, scene);
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
      planner = make_planner(what.planner, run.setup(), what.settings);
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
  const auto add = [](const std::string& scene, const PlanCase& what) {
    benchmark::RegisterBenchmark(("plan/" + what.planner + "/" + scene).c_str(),
                                 [scene, what](benchmark::State& state) { plan_in_rooms(state, scene, what); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(what.plans);
  };
  add("rooms", {"harmonic"});
  add("rooms", {"frontier-gain", {{"hypotheses", "200"}}});
  for (const std::string planner : {"harmonic", "nearest-frontier"}) {
    add("rooms-stereo", {planner, {}, planner, thin_stereo(), 1000, 700});
  }
  for (const std::string planner : {"tour", "nearest-frontier"}) {
    add("rooms-level", {.planner = planner,
                        .explorer = planner,
                        .sensor = thin_stereo(),
                        .plans = 100,
                        .is_level = true,
                        .cell_m = 0.1});
  }
  return true;
}();

}  // namespace
}  // namespace vantage
