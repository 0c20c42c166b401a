// SPDX-License-Identifier: MIT
// run/<planner>/<world>/cycle: inserts a scan and plans, along a complete run that follows its plans.
// run/<planner>/<world>/record: writes the same cycles to the record of the run.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vantage/planner/harmonic_planner.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/report/run_recorder.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/sim/simulated_sensor.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {
namespace {

constexpr std::size_t kCycles = 20;

enum class Timed { Cycle, Record };

// A run that advances one view at a time.
class RecordedRun {
 public:
  RecordedRun(const std::string& planner, const std::string& world)
      : name_(planner),
        world_(World::by_name(world)),
        robot_(std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2})),
        camera_(TriangleScene(world_.mesh), RangeSensor::preset("panoramic")) {
    const Truth truth(world_, kCellM, world_.region);
    const std::optional<Pose> start = truth.draw_start(*robot_, 1);
    if (!start) {
      throw std::runtime_error(world + ": the robot fits nowhere");
    }
    start_ = *start;
    begin();
  }
  ~RecordedRun() { std::filesystem::remove(file_); }
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  void scan() { scan_ = camera_.scan(pose_); }
  void insert_and_plan() {
    map_->insert(scan_);
    plan_ = planner_->plan(*map_, pose_);
  }
  void record() {
    ViewRecord view;
    view.view = ++views_;
    view.pose = pose_;
    view.passed = {pose_.translation()};
    const auto* harmonic = dynamic_cast<const HarmonicPlanner*>(planner_.get());
    recorder_->record(*map_, view, &plan_, harmonic != nullptr && harmonic->field() ? &*harmonic->field() : nullptr);
  }
  // Moves to the goal of the plan, or starts a new run if there is none.
  void go_on() {
    if (plan_.outcome == Outcome::Move) {
      pose_ = plan_.path.back();
    } else {
      begin();
    }
  }
  [[nodiscard]] double bytes() const { return static_cast<double>(recorder_->bytes()); }
  [[nodiscard]] double views() const { return static_cast<double>(views_); }

 private:
  static constexpr double kCellM = 0.2;

  void begin() {
    pose_ = start_;
    views_ = 0;
    map_.emplace(OccupancyMapOptions{.resolution_m = kCellM, .region = world_.region});
    map_->assume_free(robot_->body_box(pose_));
    planner_ = make_planner(name_, {.sensor = camera_.sensor(), .platform = robot_});
    recorder_.emplace(file_, RunRecorderSetup{.world = world_.name, .planner = name_, .sensor = camera_.sensor()});
  }

  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("vantage_bench_" + std::to_string(::getpid()) + ".record");
  std::string name_;
  World world_;
  std::shared_ptr<const FreeFlyer> robot_;
  SimulatedSensor camera_;
  Pose start_ = Pose::Identity();
  Pose pose_ = Pose::Identity();
  Scan scan_;
  Plan plan_;
  std::size_t views_ = 0;
  std::optional<OccupancyMap> map_;
  std::unique_ptr<ExplorationPlanner> planner_;
  std::optional<RunRecorder> recorder_;
};

void cycles(benchmark::State& state, const std::string& planner, const std::string& world, Timed timed) {
  RecordedRun run(planner, world);
  for (auto _ : state) {
    state.PauseTiming();
    run.scan();
    if (timed == Timed::Record) {
      run.insert_and_plan();
      state.ResumeTiming();
      run.record();
      state.PauseTiming();
    } else {
      state.ResumeTiming();
      run.insert_and_plan();
      state.PauseTiming();
      run.record();
    }
    state.counters["bytes_a_view"] = run.bytes() / run.views();
    run.go_on();
    state.ResumeTiming();
  }
}

const bool registered = [] {
  for (const auto& [planner, world] : {std::pair("harmonic", "rooms"), std::pair("frontier-gain", "rooms"),
                                       std::pair("harmonic", "office"), std::pair("nearest-frontier", "office")}) {
    for (const Timed timed : {Timed::Cycle, Timed::Record}) {
      const std::string name =
          std::string("run/") + planner + "/" + world + (timed == Timed::Cycle ? "/cycle" : "/record");
      benchmark::RegisterBenchmark(name.c_str(), cycles, std::string(planner), std::string(world), timed)
          ->Unit(benchmark::kMillisecond)
          ->Iterations(kCycles);
    }
  }
  return true;
}();

}  // namespace
}  // namespace vantage
