// SPDX-License-Identifier: MIT
// What an Arm caches about maps must not change its answers.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <thread>
#include <vantage/arm/arm.hpp>
#include <vector>

#include "support/tracked_arm.hpp"

namespace vantage {
namespace {

constexpr VoxelBox kAsked{{-8, -14, -4}, {24, 10, 32}};

Arm new_arm() {
  ArmOptions options;
  options.world_from_base = Eigen::Translation3d(0.1, -0.2, 0.05) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  options.declared_clear = {{{-0.4, -0.6, 0.0}, {0.6, 0.4, 1.2}}};
  options.capability.samples = 4'000;
  options.capability.cell_m = 0.1;
  options.path_iterations = 50;
  return Arm(test::tracked_arm(), options);
}

// Random changes of cells to occupied, free, unknown or contested; the share of free cells varies by round.
void change(OccupancyMap& map, std::mt19937_64& engine, int count) {
  std::uniform_int_distribution<std::int32_t> side(-24, 24);
  for (int i = 0; i < count; ++i) {
    const VoxelIndex cell{side(engine), side(engine), side(engine) + 12};
    switch (engine() % 6) {
      case 0:
        map.set(cell, Occupancy::Occupied);
        break;
      case 1:
        map.set(cell, Occupancy::Unknown);
        break;
      case 2:
        map.set_log_odds(VoxelIndex{cell}, 0.85 - 3 * 0.4);
        break;
      default:
        map.set_log_odds(VoxelBox{cell, cell + VoxelIndex{1, 1, 1}}.grown(3), -1.0);
    }
  }
}

void expect_same(const Arm& used, const OccupancyMap& map, std::mt19937_64& engine, std::size_t& admitted) {
  const Arm fresh = new_arm();
  const VoxelGrid<std::uint8_t> cells = used.admitted_cells(map, kAsked);
  ASSERT_EQ(cells.values(), fresh.admitted_cells(map, kAsked).values());
  ASSERT_EQ(used.admitted_poses(map).size(), fresh.admitted_poses(map).size());
  const Arm other = new_arm();
  for (int i = 0; i < 60; ++i) {
    const Joints joints = test::random_joints(used.chain(), engine);
    ASSERT_EQ(used.admits_joints(map, joints), other.admits_joints(map, joints));
    admitted += other.admits_joints(map, joints) ? 1U : 0U;
  }
  const Pose from = used.sensor_pose(test::random_joints(used.chain(), engine));
  const Pose to = used.sensor_pose(test::random_joints(used.chain(), engine));
  ASSERT_EQ(used.joint_path(map, from, to), new_arm().joint_path(map, from, to));
  ASSERT_EQ(used.admits_motion(map, from, to), other.admits_motion(map, from, to));
}

// Compares one arm, asked in turn about two changing maps and a map with larger cells, with new arms.
TEST(ArmMemory, AnArmThatWasAskedBeforeSaysWhatANewOneSays) {
  std::mt19937_64 engine(1);
  const Arm used = new_arm();
  std::array<OccupancyMap, 3> maps{OccupancyMap({.resolution_m = 0.05}), OccupancyMap({.resolution_m = 0.05}),
                                   OccupancyMap({.resolution_m = 0.08})};
  for (OccupancyMap& map : maps) {
    map.assume_free({{-1.6, -1.6, -1.0}, {1.6, 1.6, 1.8}});
  }
  std::size_t admitted = 0;
  std::size_t compared = 0;
  for (int round = 0; round < 18; ++round) {
    OccupancyMap& map = maps[engine() % 5 % 3];
    change(map, engine, round % 4 == 3 ? 0 : 40);
    expect_same(used, map, engine, admitted);
    ++compared;
  }
  EXPECT_EQ(compared, 18U);
  EXPECT_GT(admitted, 100U);
}

TEST(ArmMemory, ManyThreadsMayAskAtOnce) {
  std::mt19937_64 engine(2);
  std::array<OccupancyMap, 2> maps{OccupancyMap({.resolution_m = 0.05}), OccupancyMap({.resolution_m = 0.05})};
  std::array<VoxelGrid<std::uint8_t>, 2> expected;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps[i].assume_free({{-1.6, -1.6, -1.0}, {1.6, 1.6, 1.8}});
    change(maps[i], engine, 200);
    expected[i] = new_arm().admitted_cells(maps[i], kAsked);
  }
  const Arm arm = new_arm();
  const Arm copy = arm;  // NOLINT(performance-unnecessary-copy-initialization): copies share the cache
  std::array<int, 4> same{};
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < same.size(); ++thread) {
    threads.emplace_back([&, thread] {
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t map = (thread + i) % 2;
        const Arm& asked = thread < 2 ? arm : copy;
        same[thread] += asked.admitted_cells(maps[map], kAsked).values() == expected[map].values() ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(same, (std::array<int, 4>{4, 4, 4, 4}));
}

}  // namespace
}  // namespace vantage
