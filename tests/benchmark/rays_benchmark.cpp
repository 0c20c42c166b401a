// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <benchmark/benchmark_scenes.hpp>
#include <memory>
#include <string>
#include <vantage/map/octomap_bridge.hpp>
#include <vantage/raytrace/evaluate_view.hpp>
#include <vantage/raytrace/hierarchical_ray_tracer.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr double kResolutionM = 0.01;

// What all of these benchmarks look at, each part made when it is first asked for.
const ObjectScene& scene() {
  static const ObjectScene made = object_scene(kResolutionM);
  return made;
}
const RayCaster& caster() {
  static const RayCaster made(scene().map);
  return made;
}
const octomap::OcTree& tree() {
  static const std::unique_ptr<octomap::OcTree> made = to_octree(scene().map);
  return *made;
}

// The i-th of the views in an order that soon has been everywhere: a fixed sample for those who do not get far.
const Pose& view(std::size_t i) {
  constexpr std::size_t kStride = 89;
  return scene().views[i * kStride % scene().views.size()];
}

RangeSensor camera(std::size_t width, std::size_t height) {
  return RangeSensor::pinhole(width, height, 1.09, 0.857, 0.0, 4.0);
}

// The rays of a camera, or those of eq. 6 of the paper where there is no image.
struct Density {
  std::string name;
  RangeSensor sensor;
  bool equal_angles = false;

  [[nodiscard]] RayImage image() const {
    return equal_angles ? equal_angle_rays(sensor, kResolutionM)
                        : RayImage{sensor.width, sensor.height, sensor.directions()};
  }
  [[nodiscard]] ViewRays rays() const {
    const RayImage all = image();
    return {all.directions, all.width, all.height, sensor.max_range_m};
  }
};

void rays_vantage(benchmark::State& state, const Density& density) {
  const ViewRays rays = density.rays();
  std::vector<RayEnd> ends(rays.size());
  std::size_t i = 0;
  caster();
  for ([[maybe_unused]] auto _ : state) {
    caster().cast(view(i++), rays, ends);
    benchmark::DoNotOptimize(ends.data());
  }
  state.counters["rays"] = static_cast<double>(rays.size());
}

octomap::point3d to_octomap(const Eigen::Vector3d& point) {
  const Eigen::Vector3f p = point.cast<float>();
  return {p.x(), p.y(), p.z()};
}

// What castRay met: it tells unknown cells from the end of its range only on being asked again.
Occupancy cast_octomap(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double range_m,
                       octomap::point3d& end) {
  if (tree().castRay(to_octomap(from), to_octomap(along), end, false, range_m)) {
    return Occupancy::Occupied;
  }
  return tree().search(end) == nullptr ? Occupancy::Unknown : Occupancy::Free;
}

void rays_octomap(benchmark::State& state, const Density& density) {
  const std::vector<Eigen::Vector3f> directions = density.image().directions;
  std::vector<Occupancy> found(directions.size());
  const ViewRays rays = density.rays();
  std::vector<RayEnd> ends(rays.size());
  std::size_t same = 0;
  std::size_t i = 0;
  tree();
  for ([[maybe_unused]] auto _ : state) {
    const Pose& pose = view(i++);
    octomap::point3d end;
    for (std::size_t ray = 0; ray < directions.size(); ++ray) {
      found[ray] = cast_octomap(pose.translation(), pose.linear() * directions[ray].cast<double>(),
                                density.sensor.max_range_m, end);
    }
    state.PauseTiming();
    caster().cast(pose, rays, ends);
    for (std::size_t ray = 0; ray < ends.size(); ++ray) {
      same += ends[ray].occupancy == found[ray] ? 1U : 0U;
    }
    state.ResumeTiming();
  }
  state.counters["labels_equal"] = static_cast<double>(same) / static_cast<double>(i * rays.size());
}

void report(benchmark::State& state, std::size_t unknown, std::size_t occupied) {
  const auto views = static_cast<double>(state.iterations());
  state.counters["unknown"] = static_cast<double>(unknown) / views;
  state.counters["occupied"] = static_cast<double>(occupied) / views;
}

// `evaluate(pose)` returns something with counts of unknown and occupied.
template <class Evaluate>
void evaluate_each_view(benchmark::State& state, const Evaluate& evaluate) {
  std::size_t i = 0;
  std::size_t unknown = 0;
  std::size_t occupied = 0;
  scene();
  for ([[maybe_unused]] auto _ : state) {
    const auto counts = evaluate(view(i++));
    unknown += counts.unknown;
    occupied += counts.occupied;
  }
  report(state, unknown, occupied);
}

void default_vantage(benchmark::State& state, const Density& density) {
  const ViewRays rays = density.rays();
  caster();
  evaluate_each_view(state, [&](const Pose& pose) { return evaluate_view(caster(), pose, rays, scene().object); });
}

void uniform_vantage(benchmark::State& state, const Density& density) {
  const ViewRays rays = density.rays();
  const UniformRayTracer tracer(scene().map);
  evaluate_each_view(state, [&](const Pose& pose) { return tracer.evaluate(pose, rays, scene().object); });
}

bool meets(const Box& box, const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  const Eigen::Array3d a = (box.min - from).array() / along.array();
  const Eigen::Array3d b = (box.max - from).array() / along.array();
  return std::max(a.min(b).maxCoeff(), 0.0) <= a.max(b).minCoeff();
}

// Every ray by castRay; or only those that meet the object box.
void uniform_octomap(benchmark::State& state, const Density& density, bool culled) {
  const std::vector<Eigen::Vector3f> directions = density.image().directions;
  const Box box = scene().map.frame().box_of(scene().object);
  tree();
  evaluate_each_view(state, [&](const Pose& pose) {
    ViewEvaluation counts;
    octomap::KeySet seen;
    octomap::point3d end;
    for (const Eigen::Vector3f& direction : directions) {
      const Eigen::Vector3d along = pose.linear() * direction.cast<double>();
      if (culled && !meets(box, pose.translation(), along)) {
        continue;
      }
      const Occupancy met = cast_octomap(pose.translation(), along, density.sensor.max_range_m, end);
      if (met != Occupancy::Free && box.contains({end.x(), end.y(), end.z()}) &&
          seen.insert(tree().coordToKey(end)).second) {
        ++(met == Occupancy::Occupied ? counts.occupied : counts.unknown);
      }
    }
    return counts;
  });
}

constexpr int kLevels = 4;  // start depth 13 of 16

void hierarchical_vantage(benchmark::State& state, const Density& density) {
  const HierarchicalRayTracer tracer(scene().map, density.sensor, {.levels = kLevels});
  evaluate_each_view(state, [&](const Pose& pose) { return tracer.evaluate(pose, scene().object); });
}

// An octree as a map of cells of 2^level finest ones.
struct OctreeLevel {
  int level;

  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const {
    constexpr std::int32_t kOrigin = 32768;
    const auto key = [this](std::int32_t c) { return static_cast<octomap::key_type>((c << level) + kOrigin); };
    const octomap::OcTreeNode* node =
        tree().search(octomap::OcTreeKey(key(cell.x), key(cell.y), key(cell.z)), 16U - static_cast<unsigned>(level));
    return node == nullptr ? Occupancy::Unknown : tree().isNodeOccupied(node) ? Occupancy::Occupied : Occupancy::Free;
  }
};

// Algorithm 2 over the octree's own inner nodes, refining inside the object box only.
void hierarchical_octomap(benchmark::State& state, const Density& density) {
  const RayTree rays(density.sensor, kResolutionM, kLevels);
  const Box box = scene().map.frame().box_of(scene().object);
  tree();
  evaluate_each_view(state, [&](const Pose& pose) {
    return trace_hierarchically(rays, [&](int level, const Eigen::Vector3f& direction) {
      const OctreeLevel map{kLevels - 1 - level};
      const VoxelFrame frame{kResolutionM * (1 << map.level)};
      const Eigen::Vector3d& from = pose.translation();
      const RayEnd end = first_not_free(
          map, frame, from, from + density.sensor.max_range_m * (pose.linear() * direction.cast<double>()));
      const Box cell = frame.box_of(end.cell);
      const bool inside = (cell.min.array() < box.max.array()).all() && (cell.max.array() > box.min.array()).all();
      return inside ? end.occupancy : Occupancy::Free;
    });
  });
}

// The skipping structure after each of some scans of the object from its candidate views.
void update_vantage(benchmark::State& state) {
  OccupancyMap map = scene().map;
  RayCaster following(map);
  std::size_t bricks = 0;
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    map.insert(table_scan(view(i++)));
    state.ResumeTiming();
    bricks += following.update();
  }
  state.counters["bricks"] = static_cast<double>(bricks) / static_cast<double>(i);
  state.counters["bytes_per_cell"] =
      static_cast<double>(following.memory_bytes()) / static_cast<double>(map.counts().free + map.counts().occupied);
}

template <class Function, class... Arguments>
auto* add(const std::string& name, Function function, const Arguments&... arguments) {
  return benchmark::RegisterBenchmark(name.c_str(), function, arguments...)->Unit(benchmark::kMillisecond);
}

const bool kRegistered = [] {
  const Density full{"640x480", camera(640, 480)};
  const Density small{"160x120", camera(160, 120)};
  const Density paper{"paper", camera(640, 480), true};
  constexpr int kSample = 5;  // views that slow peers look at
  add("rays/vantage/640x480", rays_vantage, full);
  add("rays/octomap/640x480", rays_octomap, full)->Iterations(kSample);
  for (const Density& density : {full, small, paper}) {
    add("visibility/default/vantage/" + density.name, default_vantage, density);
    add("visibility/uniform/vantage/" + density.name, uniform_vantage, density)->Iterations(kSample);
    add("visibility/uniform/octomap/" + density.name, uniform_octomap, density, false)->Iterations(kSample);
    add("visibility/culled/octomap/" + density.name, uniform_octomap, density, true)->Iterations(4 * kSample);
  }
  add("visibility/hierarchical/vantage/paper", hierarchical_vantage, paper)->Iterations(4 * kSample);
  add("visibility/hierarchical/octomap/paper", hierarchical_octomap, paper)->Iterations(4 * kSample);
  add("rays/vantage/update", update_vantage)->Iterations(20);
  return true;
}();

}  // namespace
}  // namespace vantage
