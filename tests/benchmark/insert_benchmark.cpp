// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <benchmark/benchmark_scenes.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vantage/map/occupancy_map.hpp>

namespace vantage {
namespace {

struct Case {
  Scan scan;
  double resolution_m;
  RayPolicy policy;
};

// Every iteration fills a new map; construction and destruction are not timed.
void insert_vantage(benchmark::State& state, const Case& c) {
  OccupancyMap::Counts counts;
  double bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    auto map = std::make_unique<OccupancyMap>(OccupancyMapOptions::octomap(c.resolution_m));
    state.ResumeTiming();
    map->insert(c.scan, c.policy);
    state.PauseTiming();
    counts = map->counts();
    bytes = static_cast<double>(map->memory_bytes());
    map.reset();
    state.ResumeTiming();
  }
  const auto known = static_cast<double>(counts.free + counts.occupied);
  state.counters["known_cells"] = known;
  state.counters["bytes_per_cell"] = bytes / known;
}

// OctoMap's fastest way: lazy evaluation, with the untimed update of inner nodes left out. OctoMap writes an infinite
// range as -1.
void insert_octomap(benchmark::State& state, const Case& c) {
  octomap::Pointcloud cloud;
  const Pose& pose = c.scan.world_from_sensor;
  for (const Eigen::Vector3f& point : c.scan.points) {
    const Eigen::Vector3f p = (pose * point.cast<double>()).cast<float>();
    cloud.push_back(p.x(), p.y(), p.z());
  }
  const Eigen::Vector3f eye = pose.translation().cast<float>();
  const double range_m = std::isfinite(c.scan.max_range_m) ? c.scan.max_range_m : -1.0;
  double known = 0;
  double unpruned = 0;
  double pruned = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    auto tree = std::make_unique<octomap::OcTree>(c.resolution_m);
    state.ResumeTiming();
    tree->insertPointCloud(cloud, {eye.x(), eye.y(), eye.z()}, range_m, true, c.policy == RayPolicy::EachEndCell);
    state.PauseTiming();
    known = static_cast<double>(tree->getNumLeafNodes());
    unpruned = static_cast<double>(tree->memoryUsage());
    tree->updateInnerOccupancy();
    tree->prune();
    pruned = static_cast<double>(tree->memoryUsage());
    tree.reset();
    state.ResumeTiming();
  }
  state.counters["known_cells"] = known;
  state.counters["bytes_per_cell"] = unpruned / known;
  state.counters["bytes_per_cell_pruned"] = pruned / known;
}

// The cost of a scan should follow the scan, not the map: inserts the same scan into a map of `scans` others.
void insert_into_full_map(benchmark::State& state) {
  OccupancyMap map(OccupancyMapOptions::octomap(0.05));
  Scan scan = table_scan();
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    scan.world_from_sensor.translation().x() = 10.0 * static_cast<double>(i + 1);
    map.insert(scan, RayPolicy::EachEndCell);
  }
  scan.world_from_sensor.translation().x() = 0.0;
  map.insert(scan, RayPolicy::EachEndCell);
  for ([[maybe_unused]] auto _ : state) {
    map.insert(scan, RayPolicy::EachEndCell);
  }
  state.counters["known_cells"] = static_cast<double>(map.counts().free + map.counts().occupied);
}

// 40 halls in a row, there and back: the bricks of all halls are needed again after all others were written to.
template <class Note>
void drive_through_halls(OccupancyMap& map, const Note& after_scan) {
  constexpr int kHalls = 40;
  Scan scan = hall_scan();
  const double first_x = scan.world_from_sensor.translation().x();
  for (int step = 0; step < 2 * kHalls; ++step) {
    scan.world_from_sensor.translation().x() = first_x + 30.0 * std::min(step, 2 * kHalls - 1 - step);
    map.insert(scan);
    after_scan();
  }
}

// The map may keep a fifth, or a twentieth, of itself in memory (1: all). One iteration is 80 scans.
void insert_partly_on_disk(benchmark::State& state) {
  const OccupancyMapOptions options{.resolution_m = 0.1};
  OccupancyMap in_memory(options);
  drive_through_halls(in_memory, [] {});
  const std::size_t limit_bytes = in_memory.memory_bytes() / static_cast<std::size_t>(state.range(0));
  std::size_t most_resident = 0;
  std::size_t refused = 0;
  for ([[maybe_unused]] auto _ : state) {
    OccupancyMap map = state.range(0) > 1 ? OccupancyMap(options, std::filesystem::temp_directory_path(), limit_bytes)
                                          : OccupancyMap(options);
    drive_through_halls(map, [&] { most_resident = std::max(most_resident, map.resident_bytes()); });
    refused += map.cells_refused();
  }
  const OccupancyMap::Counts counts = in_memory.counts();
  const double known = static_cast<double>(counts.free + counts.occupied);
  const double on_heap =
      static_cast<double>(in_memory.memory_bytes()) - static_cast<double>(in_memory.brick_count() * sizeof(Brick));
  state.counters["map_mb"] = 1e-6 * static_cast<double>(in_memory.memory_bytes());
  state.counters["limit_mb"] = 1e-6 * static_cast<double>(limit_bytes);
  state.counters["resident_mb"] = 1e-6 * static_cast<double>(most_resident);
  state.counters["bytes_per_known"] = static_cast<double>(in_memory.memory_bytes()) / known;
  state.counters["always_resident_per_known"] = on_heap / known;
  state.counters["refused"] = static_cast<double>(refused);
}

// The first keyframe of the recorded lidar scans, if VANTAGE_DATA is set.
std::optional<Scan> recorded_lidar_scan() {
  const char* data = std::getenv("VANTAGE_DATA");
  if (data == nullptr) {
    return std::nullopt;
  }
  std::ifstream file(std::filesystem::path(data) / "lidar/kitti07_keyframes_5_gtsam_points/000000.points.bin",
                     std::ios::binary);
  Scan scan;
  Eigen::Vector3f point;
  while (file.read(reinterpret_cast<char*>(point.data()), sizeof(point))) {  // float32 x, y, z
    scan.points.push_back(point);
  }
  scan.world_from_sensor.translation() = Eigen::Vector3d(0.013, 0.007, 0.021);
  return scan.points.empty() ? std::nullopt : std::optional(scan);
}

void add_pair(const std::string& name, const Case& c) {
  benchmark::RegisterBenchmark(("insert/vantage/" + name).c_str(), insert_vantage, c)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("insert/octomap/" + name).c_str(), insert_octomap, c)->Unit(benchmark::kMillisecond);
}

const bool kRegistered = [] {
  add_pair("0.05", {table_scan(), 0.05, RayPolicy::EachEndCell});
  add_pair("0.01", {table_scan(), 0.01, RayPolicy::EachEndCell});
  add_pair("every_ray/0.05", {table_scan(), 0.05, RayPolicy::EveryReturn});
  add_pair("every_ray/0.01", {table_scan(), 0.01, RayPolicy::EveryReturn});
  add_pair("lidar/0.05", {hall_scan(), 0.05, RayPolicy::EveryReturn});
  if (const std::optional<Scan> scan = recorded_lidar_scan()) {
    add_pair("lidar_recorded/0.05", {*scan, 0.05, RayPolicy::EveryReturn});
  }
  benchmark::RegisterBenchmark("insert/vantage/into_map_of_scans", insert_into_full_map)
      ->Arg(0)
      ->Arg(10)
      ->Arg(100)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("insert/vantage/partly_on_disk", insert_partly_on_disk)
      ->Arg(1)
      ->Arg(5)
      ->Arg(20)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace vantage
