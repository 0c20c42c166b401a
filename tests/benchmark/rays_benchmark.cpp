// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <array>
#include <benchmark/benchmark_scenes.hpp>
#include <benchmark/octree_rays.hpp>
#include <benchmark/pixel_tree.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/planner/next_best_view_planner.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/hierarchical_ray_tracer.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

namespace vantage {
namespace {

// The scene of some benchmarks; its parts are made on first use.
class Stage {
 public:
  Stage(std::string name, double resolution_m, Surroundings surroundings)
      : name_(std::move(name)), resolution_m_(resolution_m), surroundings_(surroundings) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  [[nodiscard]] const ObjectScene& scene() const {
    if (!scene_) {
      scene_.emplace(object_scene(resolution_m_, surroundings_));
    }
    return *scene_;
  }
  [[nodiscard]] const RayCaster& caster() const {
    if (!caster_) {
      caster_.emplace(scene().map);
    }
    return *caster_;
  }
  [[nodiscard]] const octomap::OcTree& tree() const {
    if (!tree_) {
      tree_ = to_octree(scene().map);
    }
    return *tree_;
  }
  // The i-th view in a fixed order that soon covers all directions, for benchmarks with few iterations.
  [[nodiscard]] const Pose& view(std::size_t i) const {
    constexpr std::size_t kStride = 89;
    return scene().views[i * kStride % scene().views.size()];
  }

 private:
  std::string name_;
  double resolution_m_;
  Surroundings surroundings_;
  mutable std::optional<ObjectScene> scene_;
  mutable std::optional<RayCaster> caster_;
  mutable std::unique_ptr<octomap::OcTree> tree_;
};

RangeSensor camera(std::size_t width, std::size_t height) {
  return RangeSensor::pinhole(width, height, 1.09, 0.857, 0.0, 4.0);
}

// The rays of a camera image, or without an image those of eq. 6 of the paper.
struct Density {
  std::string name;
  RangeSensor sensor;
  bool equal_angles = false;

  [[nodiscard]] RayImage image(double cell_m) const {
    return equal_angles ? equal_angle_rays(sensor, cell_m)
                        : RayImage{sensor.width, sensor.height, sensor.directions()};
  }
  [[nodiscard]] ViewRays rays(double cell_m) const {
    const RayImage all = image(cell_m);
    return {all.directions, all.width, all.height, sensor.max_range_m};
  }
};

void rays_vantage(benchmark::State& state, const Stage& stage, const Density& density) {
  const ViewRays rays = density.rays(stage.resolution_m());
  std::vector<RayEnd> ends(rays.size());
  std::size_t i = 0;
  (void)stage.caster();
  for ([[maybe_unused]] auto _ : state) {
    stage.caster().cast(stage.view(i++), rays, ends);
    benchmark::DoNotOptimize(ends.data());
  }
  state.counters["rays"] = static_cast<double>(rays.size());
}

// castRay computes in single precision, so this share of its results may differ.
constexpr double kRoundedShare = 0.01;

void rays_octomap(benchmark::State& state, const Stage& stage, const Density& density) {
  const std::vector<Eigen::Vector3f> directions = density.image(stage.resolution_m()).directions;
  std::vector<Occupancy> found(directions.size());
  const ViewRays rays = density.rays(stage.resolution_m());
  std::vector<RayEnd> ends(rays.size());
  std::size_t same = 0;
  std::size_t i = 0;
  (void)stage.tree();
  for ([[maybe_unused]] auto _ : state) {
    const Pose& pose = stage.view(i++);
    octomap::point3d end;
    for (std::size_t ray = 0; ray < directions.size(); ++ray) {
      found[ray] = cast_octomap(stage.tree(), pose.translation(), pose.linear() * directions[ray].cast<double>(),
                                density.sensor.max_range_m, end);
    }
    state.PauseTiming();
    stage.caster().cast(pose, rays, ends);
    for (std::size_t ray = 0; ray < ends.size(); ++ray) {
      same += ends[ray].occupancy == found[ray] ? 1U : 0U;
    }
    state.ResumeTiming();
  }
  const double equal = static_cast<double>(same) / static_cast<double>(i * rays.size());
  state.counters["labels_equal"] = equal;
  if (equal < 1.0 - kRoundedShare) {
    state.SkipWithError("rays of vantage end elsewhere");
  }
}

void report(benchmark::State& state, std::size_t unknown, std::size_t occupied) {
  const auto views = static_cast<double>(state.iterations());
  state.counters["unknown"] = static_cast<double>(unknown) / views;
  state.counters["occupied"] = static_cast<double>(occupied) / views;
}

// Calls `evaluate(pose)` for each view and returns the sums of unknown and occupied counts.
template <class Evaluate>
ViewEvaluation evaluate_each_view(benchmark::State& state, const Stage& stage, const Evaluate& evaluate) {
  std::size_t i = 0;
  std::size_t unknown = 0;
  std::size_t occupied = 0;
  std::ignore = stage.scene();  // not timed
  for ([[maybe_unused]] auto _ : state) {
    const auto counts = evaluate(stage.view(i++));
    unknown += counts.unknown;
    occupied += counts.occupied;
  }
  report(state, unknown, occupied);
  return {unknown, occupied};
}

// Fails a benchmark whose counts differ from the expected ones by more than a share.
void require_same(benchmark::State& state, const ViewEvaluation& counted, const ViewEvaluation& expected,
                  double share) {
  const auto differ = [share](std::size_t a, std::size_t b) {
    return std::abs(static_cast<double>(a) - static_cast<double>(b)) > share * static_cast<double>(b);
  };
  if (differ(counted.unknown, expected.unknown) || differ(counted.occupied, expected.occupied)) {
    state.SkipWithError("vantage counts other cells");
  }
}

// As above, compared with the counts of vantage in the same views.
void require_counts(benchmark::State& state, const Stage& stage, const ViewRays& rays, const ViewEvaluation& counted,
                    double share) {
  ViewEvaluation expected;
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.iterations()); ++i) {
    const ViewEvaluation of_view = evaluate_view(stage.caster(), stage.view(i), rays, stage.scene().object);
    expected.unknown += of_view.unknown;
    expected.occupied += of_view.occupied;
  }
  require_same(state, counted, expected, share);
}

void default_vantage(benchmark::State& state, const Stage& stage, const Density& density) {
  const ViewRays rays = density.rays(stage.resolution_m());
  (void)stage.caster();
  evaluate_each_view(state, stage, [&](const Pose& pose) {
    return evaluate_view(stage.caster(), pose, rays, stage.scene().object);
  });
}

void uniform_vantage(benchmark::State& state, const Stage& stage, const Density& density) {
  const ViewRays rays = density.rays(stage.resolution_m());
  const UniformRayTracer tracer(stage.scene().map);
  const ViewEvaluation counted = evaluate_each_view(
      state, stage, [&](const Pose& pose) { return tracer.evaluate(pose, rays, stage.scene().object); });
  require_counts(state, stage, rays, counted, 0.0);
}

// Casts each ray with castRay; if `culled`, only rays that intersect the object's box.
void uniform_octomap(benchmark::State& state, const Stage& stage, const Density& density, bool culled) {
  const std::vector<Eigen::Vector3f> directions = density.image(stage.resolution_m()).directions;
  const Box box = stage.scene().map.frame().box_of(stage.scene().object);
  (void)stage.tree();
  const ViewEvaluation counted = evaluate_each_view(state, stage, [&](const Pose& pose) {
    ViewEvaluation counts;
    octomap::KeySet seen;
    octomap::point3d end;
    for (const Eigen::Vector3f& direction : directions) {
      const Eigen::Vector3d along = pose.linear() * direction.cast<double>();
      if (culled && !meets(box, pose.translation(), along)) {
        continue;
      }
      const Occupancy met = cast_octomap(stage.tree(), pose.translation(), along, density.sensor.max_range_m, end);
      if (met != Occupancy::Free && box.contains({end.x(), end.y(), end.z()}) &&
          seen.insert(stage.tree().coordToKey(end)).second) {
        ++(met == Occupancy::Occupied ? counts.occupied : counts.unknown);
      }
    }
    return counts;
  });
  require_counts(state, stage, density.rays(stage.resolution_m()), counted, kRoundedShare);
}

constexpr std::array kStartDepths{12, 13, 14, 15};  // of 16

// Number of levels of Algorithm 2 for a start depth in an octree of depth 16.
int levels_from(int start_depth) { return 17 - start_depth; }

void hierarchical_vantage(benchmark::State& state, const Stage& stage, const Density& density, int start_depth) {
  const HierarchicalRayTracer tracer(stage.scene().map, density.sensor, {.levels = levels_from(start_depth)});
  evaluate_each_view(state, stage, [&](const Pose& pose) { return tracer.evaluate(pose, stage.scene().object); });
}

// Algorithm 2 over the inner nodes of the octree, refined only inside the object's box. Counts like vantage.
template <class Tree>
void trace_octree(benchmark::State& state, const Stage& stage, double range_m, const Tree& rays, int levels) {
  std::vector<RayCaster> casters;
  for (int level = levels; level-- > 0;) {
    casters.emplace_back(stage.scene().map, RayCasterOptions{.level = level});
  }
  const Box box = stage.scene().map.frame().box_of(stage.scene().object);
  const auto trace = [&](const Pose& pose, const auto& cast) {
    return trace_hierarchically(rays, [&](int level, const Eigen::Vector3f& direction) {
      const RayCaster& caster = casters[static_cast<std::size_t>(level)];
      const Eigen::Vector3d along = pose.linear() * direction.cast<double>();
      return counted_inside(box, caster.frame(), cast(caster, pose.translation(), along));
    });
  };
  std::size_t casts = 0;
  (void)stage.tree();
  const ViewEvaluation counted = evaluate_each_view(state, stage, [&](const Pose& pose) {
    const HierarchicalCounts counts = trace(pose, [&](const RayCaster& caster, const auto& from, const auto& along) {
      return cast_octomap_at(stage.tree(), caster.options().level, from, along, range_m);
    });
    casts += counts.casts;
    return counts;
  });
  ViewEvaluation expected;
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.iterations()); ++i) {
    const HierarchicalCounts counts =
        trace(stage.view(i), [&](const RayCaster& caster, const auto& from, const auto& along) {
          return caster.cast(from, from + range_m * along);
        });
    expected.unknown += counts.unknown;
    expected.occupied += counts.occupied;
  }
  state.counters["casts"] = static_cast<double>(casts) / static_cast<double>(state.iterations());
  require_same(state, counted, expected, kRoundedShare);
}

void hierarchical_octomap(benchmark::State& state, const Stage& stage, const Density& density, int start_depth) {
  const int levels = levels_from(start_depth);
  if (density.equal_angles) {
    trace_octree(state, stage, density.sensor.max_range_m, RayTree(density.sensor, stage.resolution_m(), levels),
                 levels);
  } else {
    trace_octree(state, stage, density.sensor.max_range_m, PixelTree(density.sensor, levels), levels);
  }
}

// All views, with one or more threads.
void all_vantage(benchmark::State& state, const Stage& stage, const Density& density, std::size_t threads) {
  const ViewRays rays = density.rays(stage.resolution_m());
  (void)stage.caster();
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        evaluate_views(stage.caster(), stage.scene().views, rays, stage.scene().object, threads));
  }
  state.counters["views"] = static_cast<double>(stage.scene().views.size());
}

// Updates the ray caster after each of some scans of the object from its candidate views.
void update_vantage(benchmark::State& state, const Stage& stage) {
  OccupancyMap map = stage.scene().map;
  RayCaster following(map);
  std::size_t bricks = 0;
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    map.insert(table_scan(stage.view(i++)));
    state.ResumeTiming();
    bricks += following.update();
  }
  state.counters["bricks"] = static_cast<double>(bricks) / static_cast<double>(i);
  state.counters["bytes_per_cell"] =
      static_cast<double>(following.memory_bytes()) / static_cast<double>(map.counts().free + map.counts().occupied);
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Complete cycles of the planner next-best-view until the object is finished, then from the start, with times per
// stage.
void cycle_vantage(benchmark::State& state, const Stage& stage) {
  const Box object = stage.scene().map.frame().box_of(stage.scene().object);
  const auto platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.05});
  const PlannerSetup setup{.sensor = camera(640, 480), .platform = platform};
  std::optional<OccupancyMap> map;
  std::optional<NextBestViewPlanner> planner;
  Plan plan;
  double insert_ms = 0.0;
  PlanStatistics sum;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    if (plan.outcome != Outcome::Move) {
      map.emplace(stage.scene().map);
      planner.emplace(setup, NextBestViewOptions{.candidates = {.object = object}});
      plan = planner->plan(*map, stage.view(0));  // constructs the caster before timing
    }
    const Pose here = plan.goal.pose;
    const Scan scan = table_scan(here);
    state.ResumeTiming();
    const auto start = std::chrono::steady_clock::now();
    map->insert(scan);
    insert_ms += milliseconds_since(start);
    plan = planner->plan(*map, here);
    sum.survey_ms += plan.statistics.survey_ms;
    sum.evaluate_ms += plan.statistics.evaluate_ms;
    sum.choose_ms += plan.statistics.choose_ms;
    sum.path_ms += plan.statistics.path_ms;
  }
  const auto mean = [&](double all_ms) { return all_ms / static_cast<double>(state.iterations()); };
  state.counters["1_insert_ms"] = mean(insert_ms);
  state.counters["2_follow_ms"] = mean(sum.survey_ms);
  state.counters["3_evaluate_ms"] = mean(sum.evaluate_ms);
  state.counters["4_choose_ms"] = mean(sum.choose_ms);
  state.counters["5_path_ms"] = mean(sum.path_ms);
}

template <class Function, class... Arguments>
auto* add(const std::string& name, Function function, Arguments... arguments) {
  return benchmark::RegisterBenchmark(name.c_str(), function, arguments...)->Unit(benchmark::kMillisecond);
}

void add_visibility(const Stage& stage, const Density& density) {
  constexpr int kSample = 5;  // number of views for slow peers
  const std::string name = density.name + stage.name();
  const auto of = [&stage](auto function) {
    return [&stage, function](benchmark::State& state, const Density& rays, auto... more) {
      function(state, stage, rays, more...);
    };
  };
  add("visibility/default/vantage/" + name, of(default_vantage), density);
  add("visibility/uniform/vantage/" + name, of(uniform_vantage), density)->Iterations(kSample);
  add("visibility/uniform/octomap/" + name, of(uniform_octomap), density, false)->Iterations(kSample);
  add("visibility/culled/octomap/" + name, of(uniform_octomap), density, true)->Iterations(4 * kSample);
  for (const int depth : kStartDepths) {
    add("visibility/hierarchical_from_" + std::to_string(depth) + "/octomap/" + name, of(hierarchical_octomap),
        density, depth)
        ->Iterations(4 * kSample);
  }
  if (density.equal_angles) {
    constexpr int kMiddle = 13;
    add("visibility/hierarchical_from_13/vantage/" + name, of(hierarchical_vantage), density, kMiddle)
        ->Iterations(4 * kSample);
  }
  for (const std::size_t threads : {1U, 2U}) {
    add("visibility/all_views/vantage/" + name + "/" + std::to_string(threads) +
            (threads == 1 ? "_thread" : "_threads"),
        of(all_vantage), density, threads)
        ->UseRealTime();
  }
}

const bool kRegistered = [] {
  static const Stage table("", 0.01, Surroundings::Known);
  static const Stage coarse("/0.05", 0.05, Surroundings::Known);
  static const Stage scanned("/scanned", 0.01, Surroundings::Scanned);
  const Density full{"640x480", camera(640, 480)};
  const Density small{"160x120", camera(160, 120)};
  const Density paper{"paper", camera(640, 480), true};
  constexpr int kSample = 5;
  const auto at_table = [](auto function) {
    return [function](benchmark::State& state, auto... more) { function(state, table, more...); };
  };
  add("rays/vantage/640x480", at_table(rays_vantage), full);
  add("rays/octomap/640x480", at_table(rays_octomap), full)->Iterations(kSample);
  for (const Stage* stage : {&table, &coarse, &scanned}) {
    for (const Density& density : {full, small, paper}) {
      add_visibility(*stage, density);
    }
  }
  add("rays/vantage/update", at_table(update_vantage))->Iterations(20);
  add("plan/next-best-view/table", at_table(cycle_vantage))->Iterations(20);
  return true;
}();

}  // namespace
}  // namespace vantage
