// SPDX-License-Identifier: MIT
// plan/<planner>/mine: a robot with a lidar explores a mine of 250 x 330 m with drifts of 4 x 3 m in cells of 0.2 m.
// It plans after every scan and goes at most 2 m in between. VANTAGE_MINE_SCANS: how many scans (300). Times a scan
// and its plan; `p50_ms` and `p99_ms` are those of a plan alone, processor time, `cell_b` the bytes of the map for
// each known cell, `heap_b` those of map and planner together.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>
#include <vantage/planner/assume_free.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr double kCellM = 0.2;
constexpr VoxelBox kMine{{0, 0, 0}, {1250, 1650, 15}};
constexpr std::int32_t kSpacing = 120;  // between drifts
constexpr std::int32_t kWidth = 20;
constexpr double kRangeM = 20.0;
constexpr double kStepM = 2.0;

bool is_rock(const VoxelIndex& cell) {
  return !kMine.contains(cell) || (cell.x % kSpacing >= kWidth && cell.y % kSpacing >= kWidth);
}

// Every ray ends a quarter of a cell inside the first cell of rock.
Scan scan_of_mine(const VoxelFrame& frame, const std::vector<Eigen::Vector3f>& rays, const Pose& pose) {
  Scan scan{.world_from_sensor = pose, .max_range_m = kRangeM};
  for (const Eigen::Vector3f& ray : rays) {
    const Eigen::Vector3d towards = pose.linear() * ray.cast<double>();
    double length_m = 0.0;
    while (length_m < kRangeM && !is_rock(frame.cell_of(pose.translation() + length_m * towards))) {
      length_m += 0.25 * kCellM;
    }
    if (length_m < kRangeM) {
      scan.points.push_back(static_cast<float>(length_m) * ray);
    } else {
      scan.no_return.push_back(ray);
    }
  }
  return scan;
}

// The pose after a step along the path, at a place where the body fits.
Pose after_step(const Plan& plan, const Platform& platform, const OccupancyMap& map) {
  double left_m = kStepM;
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    const Eigen::Vector3d way = plan.path[i].translation() - plan.path[i - 1].translation();
    if (way.norm() >= left_m) {
      Pose between = plan.path[i];
      between.translation() = plan.path[i - 1].translation() + way * (left_m / way.norm());
      return platform.admits(map, between) ? between : plan.path[i - 1];
    }
    left_m -= way.norm();
  }
  return plan.path.back();
}

double heap_bytes() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

void explore_mine(benchmark::State& state, const std::string& name) {
  const char* const text = std::getenv("VANTAGE_MINE_SCANS");
  const std::size_t scans = text != nullptr ? std::strtoul(text, nullptr, 10) : 300;
  RangeSensor sensor = RangeSensor::spherical(512, 64, 2.0 * std::numbers::pi, 0.5 * std::numbers::pi, 0.1, kRangeM);
  sensor.reports_no_return = true;
  const std::vector<Eigen::Vector3f> rays = sensor.directions();
  const auto platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.4});
  const double before = heap_bytes();
  OccupancyMap map({.resolution_m = kCellM, .region = Box{{-1, -1, -1}, {251, 331, 4}}});
  const auto planner = make_planner(name, {.sensor = sensor, .platform = platform});
  Pose pose = pose_looking({2.1, 2.1, 1.5}, 0.0);
  assume_free(map, *platform, pose);
  std::vector<double> plan_ms;
  for (auto _ : state) {
    for (std::size_t scan = 0; scan < scans; ++scan) {
      map.insert(scan_of_mine(map.frame(), rays, pose));
      const std::clock_t start = std::clock();
      const Plan plan = planner->plan(map, pose);
      plan_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      if (plan.outcome != Outcome::Move) {
        break;
      }
      pose = after_step(plan, *platform, map);
    }
  }
  const OccupancyMap::Counts counts = map.counts();
  const double known = static_cast<double>(counts.free + counts.occupied);
  std::sort(plan_ms.begin(), plan_ms.end());
  state.counters["plans"] = static_cast<double>(plan_ms.size());
  state.counters["known"] = known;
  state.counters["p50_ms"] = plan_ms[plan_ms.size() / 2];
  state.counters["p99_ms"] = plan_ms[(plan_ms.size() - 1) * 99 / 100];
  state.counters["cell_b"] = static_cast<double>(map.memory_bytes()) / known;
  state.counters["heap_b"] = (heap_bytes() - before) / known;
}

const bool registered = [] {
  for (const std::string_view planner : planner_names()) {
    benchmark::RegisterBenchmark(("plan/" + std::string(planner) + "/mine").c_str(),
                                 [planner](benchmark::State& state) { explore_mine(state, std::string(planner)); })
        ->Unit(benchmark::kSecond)
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
}  // namespace vantage
