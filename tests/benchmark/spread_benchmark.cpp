// SPDX-License-Identifier: MIT
// plan/nearest-frontier/tunnel-folded, plan/nearest-frontier/tunnel-spread: the same tunnel of ten million known
// cells of 0.1 m, folded into a compact block, and as a staircase over 2 x 2 km. Times a complete plan after the
// cells in front of a hole in the wall became known. The cost should follow the cells, not their bounding box.
// `map_mb` is the memory of the map.
#include <benchmark/benchmark.h>

#include <memory>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr std::int32_t kWidth = 16;
constexpr std::int32_t kLength = 256;
constexpr int kSegments = 150;

enum class Course : std::uint8_t { Folded, Spread };

// Boxes of free cells; each overlaps the next.
std::vector<VoxelBox> tunnel(Course course) {
  std::vector<VoxelBox> boxes;
  VoxelIndex at{0, 0, 0};
  for (int segment = 0; segment < kSegments; ++segment) {
    if (course == Course::Spread) {
      const bool along_x = segment % 2 == 0;
      boxes.push_back({at, at + VoxelIndex{along_x ? kLength : kWidth, along_x ? kWidth : kLength, kWidth}});
      at = at + VoxelIndex{along_x ? kLength - kWidth : 0, along_x ? 0 : kLength - kWidth, 0};
    } else {
      boxes.push_back({at, at + VoxelIndex{kLength, kWidth, kWidth}});
      const VoxelIndex end = at + VoxelIndex{segment % 2 == 0 ? kLength - kWidth : 0, 0, 0};
      boxes.push_back({end, end + VoxelIndex{kWidth, 2 * kWidth + 1, kWidth}});
      at.y += kWidth + 1;
    }
  }
  return boxes;
}

struct Tunnel {
  OccupancyMap map{{.resolution_m = 0.1}};
  std::vector<VoxelIndex> holes;

  explicit Tunnel(Course course) {
    const std::vector<VoxelBox> boxes = tunnel(course);
    for (const VoxelBox& box : boxes) {
      map.set_log_odds(box.grown(1), 3.5);
    }
    for (const VoxelBox& box : boxes) {
      map.set_log_odds(box, -2.0);
      holes.push_back({(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2, box.hi.z});
    }
    for (const VoxelIndex& hole : holes) {
      for_each_cell({hole, hole + VoxelIndex{3, 3, 1}},
                    [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Unknown); });
    }
  }
};

void plan_in_tunnel(benchmark::State& state, Course course) {
  const OccupancyMap::Counts counts = Tunnel(course).map.counts();
  Tunnel tunnel(course);
  PlannerSetup setup{.sensor = RangeSensor::preset("kinect"),
                     .platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.3})};
  const auto planner = make_planner("nearest-frontier", setup, {});
  const Pose pose = pose_looking({0.85, 0.85, 0.85}, 0.0);
  (void)planner->plan(tunnel.map, pose);
  std::size_t next = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const VoxelIndex hole = tunnel.holes[next++ % tunnel.holes.size()];
    tunnel.map.set(hole, Occupancy::Occupied);
    state.ResumeTiming();
    benchmark::DoNotOptimize(planner->plan(tunnel.map, pose));
  }
  state.counters["known"] = static_cast<double>(counts.free + counts.occupied);
  state.counters["map_mb"] = static_cast<double>(tunnel.map.memory_bytes()) / 1e6;
}

const bool registered = [] {
  for (const auto& [name, course] : {std::pair{"plan/nearest-frontier/tunnel-folded", Course::Folded},
                                     {"plan/nearest-frontier/tunnel-spread", Course::Spread}}) {
    benchmark::RegisterBenchmark(name, [course = course](benchmark::State& state) { plan_in_tunnel(state, course); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(10);
  }
  return true;
}();

}  // namespace
}  // namespace vantage
