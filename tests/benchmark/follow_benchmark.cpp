// SPDX-License-Identifier: MIT
// What it costs to keep a map in step with the map of a host.
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <benchmark/benchmark_scenes.hpp>
#include <memory>
#include <vantage/map/map_follower.hpp>
#include <vantage/map/octomap_bridge.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr VoxelBox kRoom{{0, 0, 0}, {200, 200, 40}};

// Free space with a floor, a ceiling and four walls.
OccupancyMap room_of_bricks() {
  OccupancyMap map;
  map.set_log_odds(kRoom, 3.5);
  map.set_log_odds(kRoom.grown(-1), -2.0);
  return map;
}

octomap::Pointcloud cloud_of(const Scan& scan) {
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& point : scan.points) {
    const Eigen::Vector3f p = (scan.world_from_sensor * point.cast<double>()).cast<float>();
    cloud.push_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

octomap::point3d eye_of(const Scan& scan) {
  const Eigen::Vector3f eye = scan.world_from_sensor.translation().cast<float>();
  return {eye.x(), eye.y(), eye.z()};
}

// A room of 1.6 million cells: 3,125 bricks, one by one.
void assign_bricks(benchmark::State& state) {
  const OccupancyMap room = room_of_bricks();
  double known = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    auto map = std::make_unique<OccupancyMap>();
    state.ResumeTiming();
    room.for_each_brick(
        [&](const VoxelIndex& brick, const Brick& cells) { map->assign(brick, cells.known, cells.occupied); });
    state.PauseTiming();
    known = static_cast<double>(map->counts().free + map->counts().occupied);
    map.reset();
    state.ResumeTiming();
  }
  state.counters["known_cells"] = known;
}

// The dense grid of a host that holds the same room.
struct DenseGrid {
  std::vector<Occupancy> cells;

  [[nodiscard]] Occupancy at(const VoxelIndex& cell) const {
    return cells[static_cast<std::size_t>((cell.z * 200 + cell.y) * 200 + cell.x)];
  }
};

DenseGrid dense_grid() {
  DenseGrid grid;
  const OccupancyMap room = room_of_bricks();
  for_each_cell(kRoom, [&](const VoxelIndex& cell) { grid.cells.push_back(room.at(cell)); });
  return grid;
}

// The whole grid into an empty map (0), or into one that holds it already (1).
void follow_grid(benchmark::State& state) {
  const DenseGrid grid = dense_grid();
  MapFollower held(OccupancyMapOptions{});
  held.update(grid, kRoom);
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    auto fresh = std::make_unique<MapFollower>(OccupancyMapOptions{});
    MapFollower& follower = state.range(0) == 0 ? *fresh : held;
    state.ResumeTiming();
    benchmark::DoNotOptimize(follower.update(grid, kRoom));
    state.PauseTiming();
    fresh.reset();
    state.ResumeTiming();
  }
  state.counters["known_cells"] = static_cast<double>(held.map().counts().free + held.map().counts().occupied);
}

// One depth scan: all of its cells have changed.
void follow_octomap(benchmark::State& state) {
  const Scan scan = table_scan();
  const octomap::Pointcloud cloud = cloud_of(scan);
  double known = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    octomap::OcTree tree(0.02);
    OctomapFollower follower(tree);
    tree.insertPointCloud(cloud, eye_of(scan), -1.0, false, true);
    state.ResumeTiming();
    follower.update();
    state.PauseTiming();
    known = static_cast<double>(follower.map().counts().free + follower.map().counts().occupied);
    state.ResumeTiming();
  }
  state.counters["known_cells"] = known;
}

void resync_octomap(benchmark::State& state) {
  const Scan scan = table_scan();
  octomap::OcTree tree(0.02);
  tree.insertPointCloud(cloud_of(scan), eye_of(scan), -1.0, false, true);
  tree.prune();
  OctomapFollower follower(tree);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(follower.resync());
  }
  state.counters["known_cells"] =
      static_cast<double>(follower.map().counts().free + follower.map().counts().occupied);
}

const bool kRegistered = [] {
  benchmark::RegisterBenchmark("follow/assign", assign_bricks)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("follow/grid", follow_grid)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("follow/octomap", follow_octomap)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("follow/octomap_resync", resync_octomap)->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace vantage
