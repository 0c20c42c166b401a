// SPDX-License-Identifier: MIT
// plan/<planner>/tunnel-folded, plan/<planner>/tunnel-spread: the same tunnel of ten million known cells of 0.1 m,
// folded into a compact block, and as a staircase over 2 x 2 km. Times a complete plan after the cells in front of a
// hole in the wall became known. The cost should follow the cells, not their bounding box. `first_ms` is the
// processor time of the first plan, `map_mb` the memory of the map, `planner_mb` that of the planner after the last
// plan.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <ctime>
#include <memory>
#include <string>
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

double megabytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

void plan_in_tunnel(benchmark::State& state, const std::string& name, Course course) {
  Tunnel tunnel(course);
  const OccupancyMap::Counts counts = tunnel.map.counts();
  const double before_mb = megabytes_in_use();
  const auto planner =
      make_planner(name, {.sensor = RangeSensor::preset("kinect"),
                          .platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.3})});
  const Pose pose = pose_looking({0.85, 0.85, 0.85}, 0.0);
  const std::clock_t start = std::clock();
  (void)planner->plan(tunnel.map, pose);
  const double first_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::size_t next = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const VoxelIndex hole = tunnel.holes[next++ % tunnel.holes.size()];
    tunnel.map.set(hole, Occupancy::Occupied);
    state.ResumeTiming();
    benchmark::DoNotOptimize(planner->plan(tunnel.map, pose));
  }
  state.counters["known"] = static_cast<double>(counts.free + counts.occupied);
  state.counters["first_ms"] = first_ms;
  state.counters["map_mb"] = static_cast<double>(tunnel.map.memory_bytes()) / 1e6;
  state.counters["planner_mb"] = megabytes_in_use() - before_mb;
}

const bool registered = [] {
  for (const std::string_view planner : planner_names()) {
    for (const auto& [name, course] :
         {std::pair{"/tunnel-folded", Course::Folded}, {"/tunnel-spread", Course::Spread}}) {
      benchmark::RegisterBenchmark(("plan/" + std::string(planner) + name).c_str(),
                                   [planner, course = course](benchmark::State& state) {
                                     plan_in_tunnel(state, std::string(planner), course);
                                   })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(10);
    }
  }
  return true;
}();

}  // namespace
}  // namespace vantage
