// SPDX-License-Identifier: MIT
// frontier/<way>/<world> and void/<way>/<world>: frontier and void cells after one more scan of a depth camera, in a
// map of 60 scans from all over the world; 0.05 m unless the name gives another resolution. `incremental` updates
// cells and clusters, `full` computes both anew, `full_cells` only the cells.
// frontier_and_void/<way>/<world>: both after a scan.
// plan/<planner>/<world>: a complete plan in that map.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vantage/frontier/frontier_tracker.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/frontier/void_tracker.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {
namespace {

constexpr std::size_t kBefore = 60;
constexpr std::size_t kMeasured = 40;
constexpr std::size_t kPlanned = 10;

const FreeFlyerOptions kRobot{.radius_m = 0.2};

struct Sequence {
  double resolution_m;
  std::vector<Scan> scans;
};

Sequence record(const World& world, double resolution_m) {
  const Truth truth(world, resolution_m, world.region);
  SimulatedSensor camera(TriangleScene(world.mesh), RangeSensor::preset("realsense"));
  const FreeFlyer flyer(kRobot);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Sequence sequence{resolution_m, {}};
  while (sequence.scans.size() < kBefore + kMeasured) {
    const Eigen::Array3d place(share(engine), share(engine), share(engine));
    const Pose pose = pose_looking(world.region.min + (place * world.region.extent().array()).matrix(),
                                   6.28 * share(engine), 0.8 * share(engine) - 0.4);
    if (flyer.admits(truth.map(), pose)) {
      sequence.scans.push_back(camera.scan(pose));
    }
  }
  return sequence;
}

const Sequence& sequence_of(const std::string& name) {
  static std::map<std::string, Sequence> all;
  if (const auto found = all.find(name); found != all.end()) {
    return found->second;
  }
  const char* data = std::getenv("VANTAGE_DATA");
  const std::filesystem::path folder = data == nullptr ? "" : data;
  const std::string place = name.substr(0, name.find('/'));
  const World world = place == "house"
                          ? World::from_file(folder / "environments/aws_small_house/small_house_visual.ply")
                      : place == "geb079" ? World::from_file(folder / "octomaps/geb079.bt")
                                          : World::by_name(place);
  return all.emplace(name, record(world, name == place ? 0.05 : std::stod(name.substr(place.size() + 1))))
      .first->second;
}

// Calls `measured(map)`, timed, after every further scan, and `prepared(map)`, untimed, before the first.
template <class Prepared, class Measured>
void after_every_scan(benchmark::State& state, const std::string& world, const Prepared& prepared,
                      const Measured& measured) {
  const Sequence& sequence = sequence_of(world);
  OccupancyMap map({.resolution_m = sequence.resolution_m});
  for (std::size_t i = 0; i < kBefore; ++i) {
    map.insert(sequence.scans[i]);
  }
  prepared(map);
  std::size_t next = kBefore;
  for (auto _ : state) {
    state.PauseTiming();
    map.insert(sequence.scans[next++]);
    state.ResumeTiming();
    measured(map);
  }
  state.counters["known_cells"] = static_cast<double>(map.counts().free + map.counts().occupied);
  state.counters["frontier_cells"] = static_cast<double>(count_frontier_cells(map));
}

void incremental(benchmark::State& state, const std::string& world) {
  std::unique_ptr<FrontierTracker> tracker;
  after_every_scan(
      state, world, [&](const OccupancyMap& map) { tracker = std::make_unique<FrontierTracker>(map); },
      [&](const OccupancyMap&) { benchmark::DoNotOptimize(tracker->update()); });
  state.counters["clusters"] = static_cast<double>(tracker->cluster_count());
}

void full(benchmark::State& state, const std::string& world) {
  after_every_scan(
      state, world, [](const OccupancyMap&) {},
      [](const OccupancyMap& map) { benchmark::DoNotOptimize(frontier_clusters(frontier_cells(map))); });
}

void voids_incremental(benchmark::State& state, const std::string& world) {
  std::unique_ptr<VoidTracker> tracker;
  std::size_t new_hulls = 0;
  after_every_scan(
      state, world, [&](const OccupancyMap& map) { tracker = std::make_unique<VoidTracker>(map); },
      [&](const OccupancyMap&) { new_hulls += tracker->update() ? 1U : 0U; });
  state.counters["void_cells"] = static_cast<double>(tracker->cell_count());
  state.counters["new_hulls"] = static_cast<double>(new_hulls);
}

void voids_full(benchmark::State& state, const std::string& world) {
  after_every_scan(
      state, world, [](const OccupancyMap&) {},
      [](const OccupancyMap& map) { benchmark::DoNotOptimize(void_cells(map)); });
}

void both_incremental(benchmark::State& state, const std::string& world) {
  std::unique_ptr<FrontierTracker> frontiers;
  std::unique_ptr<VoidTracker> voids;
  after_every_scan(
      state, world,
      [&](const OccupancyMap& map) {
        frontiers = std::make_unique<FrontierTracker>(map);
        voids = std::make_unique<VoidTracker>(map);
      },
      [&](const OccupancyMap&) {
        benchmark::DoNotOptimize(frontiers->update());
        benchmark::DoNotOptimize(voids->update());
      });
}

void both_full(benchmark::State& state, const std::string& world) {
  after_every_scan(
      state, world, [](const OccupancyMap&) {},
      [](const OccupancyMap& map) {
        benchmark::DoNotOptimize(frontier_clusters(frontier_cells(map)));
        benchmark::DoNotOptimize(void_cells(map));
      });
}

// The latest camera pose that the map admits. A single scan rarely shows enough space for the body.
Pose place_in(const OccupancyMap& map, const Sequence& sequence, const FreeFlyer& flyer, std::size_t scans) {
  for (std::size_t i = scans; i-- > 0;) {
    if (flyer.admits(map, sequence.scans[i].world_from_sensor)) {
      return sequence.scans[i].world_from_sensor;
    }
  }
  return sequence.scans[scans - 1].world_from_sensor;
}

void plan(benchmark::State& state, std::string_view name, const std::string& world) {
  const auto flyer = std::make_shared<const FreeFlyer>(kRobot);
  const auto planner = make_planner(name, {.sensor = RangeSensor::preset("realsense"), .platform = flyer});
  const Sequence& sequence = sequence_of(world);
  std::size_t next = kBefore;  // scans in the map
  Plan latest;
  const auto plan_in = [&](const OccupancyMap& map) {
    latest = planner->plan(map, place_in(map, sequence, *flyer, next++));
  };
  after_every_scan(state, world, plan_in, plan_in);
  state.counters["reachable_cells"] = static_cast<double>(latest.statistics.reachable_cells);
  state.counters["void_cells"] = static_cast<double>(latest.statistics.void_cells);
  state.counters["operations"] = static_cast<double>(latest.statistics.ray_operations);
  state.counters["survey_ms"] = latest.statistics.survey_ms;
}

void full_cells(benchmark::State& state, const std::string& world) {
  after_every_scan(
      state, world, [](const OccupancyMap&) {},
      [](const OccupancyMap& map) { benchmark::DoNotOptimize(frontier_cells(map)); });
}

const bool registered = [] {
  std::vector<std::string> worlds{"office"};
  if (std::getenv("VANTAGE_DATA") != nullptr) {
    worlds.insert(worlds.end(), {"house", "geb079", "geb079/0.1"});
  }
  const std::map<std::string, void (*)(benchmark::State&, const std::string&)> ways{
      {"frontier/incremental", incremental},
      {"frontier/full", full},
      {"frontier/full_cells", full_cells},
      {"void/incremental", voids_incremental},
      {"void/full", voids_full},
      {"frontier_and_void/incremental", both_incremental},
      {"frontier_and_void/full", both_full}};
  const auto add = [](const std::string& name, std::size_t iterations, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(static_cast<benchmark::IterationCount>(iterations));
  };
  for (const std::string& world : worlds) {
    for (const auto& [name, run] : ways) {
      add(name + "/" + world, kMeasured, [run = run, world](benchmark::State& state) { run(state, world); });
    }
    for (const std::string_view planner : planner_names()) {
      add("plan/" + std::string(planner) + "/" + world, kPlanned,
          [planner, world](benchmark::State& state) { plan(state, planner, world); });
    }
  }
  return true;
}();

}  // namespace
}  // namespace vantage
