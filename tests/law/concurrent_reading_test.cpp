// SPDX-License-Identifier: MIT
// Any number of threads may read a map at the same time. Most useful under the thread sanitizer.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <thread>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/frontier/void_cells.hpp>
#include <vantage/planner/make_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

#include "contract/cell_world.hpp"
#include "support/random_maps.hpp"

namespace vantage {
namespace {

constexpr std::size_t kThreads = 4;

/// Calls `read` in several threads at once and returns the results.
template <class Read>
auto in_threads(const Read& read) {
  std::vector<decltype(read())> answers(kThreads);
  std::vector<std::thread> threads;
  for (auto& answer : answers) {
    threads.emplace_back([&answer, &read] { answer = read(); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return answers;
}

struct Reading {
  std::vector<VoxelIndex> known;
  std::vector<VoxelIndex> changed;
  double log_odds = 0.0;
  std::size_t coarse_free = 0;
  std::size_t frontier = 0;
  std::size_t voids = 0;

  bool operator==(const Reading&) const = default;
};

Reading all_of(const OccupancyMap& map) {
  Reading reading;
  map.for_each_known([&](const VoxelIndex& cell, Occupancy) {
    reading.known.push_back(cell);
    reading.log_odds += map.log_odds(cell).value();
    const VoxelIndex coarse{cell.x >> 2, cell.y >> 2, cell.z >> 2};
    reading.coarse_free += map.at(coarse, 2, CoarseningPolicy::Max) == Occupancy::Free ? 1U : 0U;
  });
  reading.changed = map.changed_since(1);
  reading.frontier = count_frontier_cells(map);
  reading.voids = count_void_cells(map);
  return reading;
}

TEST(ConcurrentReading, OfAMapGivesEveryThreadTheSame) {
  std::mt19937 engine(31);
  std::size_t maps = 0;
  for (; maps < 4; ++maps) {
    const OccupancyMap map = test::random_map(engine, 0.2);
    const Reading alone = all_of(map);
    EXPECT_GT(alone.known.size(), 1000U);
    EXPECT_GT(alone.frontier, 100U);
    for (const Reading& reading : in_threads([&] { return all_of(map); })) {
      EXPECT_EQ(reading, alone);
    }
  }
  EXPECT_EQ(maps, 4U);
}

// Threads share map, platform and sensor; each has its own planner.
TEST(ConcurrentReading, PlannersInThreadsOfTheirOwnPlanAsOneAlone) {
  const auto platform = std::make_shared<const FreeFlyer>(FreeFlyerOptions{.radius_m = 0.1});
  const RangeSensor sensor = RangeSensor::preset("panoramic").rays_for(1.0);
  std::size_t moves = 0;
  for (const std::string_view name : planner_names()) {
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
      const testing::CellWorld world = testing::make_cell_world(testing::Furniture::Rooms, seed);
      OccupancyMap map({.resolution_m = world.frame.size_m, .region = world.frame.box_of(world.solid.box())});
      const Pose pose = pose_looking(world.frame.centre_of(world.start), 0.3);
      map.assume_free(platform->body_box(pose));
      map.insert(testing::scan_cells_of(world, sensor, pose));
      const auto plan = [&] { return make_planner(name, {.sensor = sensor, .platform = platform})->plan(map, pose); };
      const Plan alone = plan();
      moves += alone.outcome == Outcome::Move ? 1U : 0U;
      for (const Plan& other : in_threads(plan)) {
        EXPECT_EQ(other.outcome, alone.outcome) << name;
        EXPECT_EQ(other.goal.pose.matrix(), alone.goal.pose.matrix()) << name;
        ASSERT_EQ(other.path.size(), alone.path.size()) << name;
      }
    }
  }
  EXPECT_EQ(moves, 2 * planner_names().size());
}

}  // namespace
}  // namespace vantage
