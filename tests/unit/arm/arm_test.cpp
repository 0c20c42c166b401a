// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vantage/arm/arm.hpp>

#include "support/tracked_arm.hpp"

namespace vantage {
namespace {

constexpr double kCell = 0.05;

/// The arm of tests/support, moved and turned, with few postures to be fast.
ArmOptions few_postures() {
  ArmOptions options;
  options.world_from_base = Eigen::Translation3d(0.1, -0.2, 0.05) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  options.capability.samples = 20'000;
  options.capability.cell_m = 0.1;
  return options;
}

const Arm& arm() {
  static const Arm one(test::tracked_arm(), few_postures());
  return one;
}

/// A map with free space all around the arm.
OccupancyMap free_space() {
  OccupancyMap map({.resolution_m = kCell});
  map.assume_free({{-1.6, -1.6, -1.0}, {1.6, 1.6, 1.8}});
  return map;
}

/// As above, with single cells occupied, unknown or contested.
OccupancyMap littered_space(std::mt19937_64& engine, int count) {
  OccupancyMap map = free_space();
  std::uniform_int_distribution<std::int32_t> side(-20, 20);
  for (int i = 0; i < count; ++i) {
    const VoxelIndex cell{side(engine), side(engine), side(engine) + 12};
    if (i % 3 == 2) {
      map.set_log_odds(VoxelIndex{cell}, 0.85 - 3 * 0.4);
    } else {
      map.set(cell, i % 3 == 0 ? Occupancy::Occupied : Occupancy::Unknown);
    }
  }
  return map;
}

/// By definition: sample points along every moving capsule; all cells within its radius plus `fatter_m` must be
/// clear.
bool body_is_clear(const OccupancyMap& map, const Joints& joints, double fatter_m) {
  const KinematicChain& chain = arm().chain();
  const std::vector<Pose> links = chain.link_poses(joints);
  for (const Capsule& capsule : chain.capsules()) {
    if (chain.joints_before(capsule.link) == 0) {
      continue;
    }
    const Pose pose = arm().options().world_from_base * links[capsule.link];
    for (int i = 0; i <= 200; ++i) {
      const Eigen::Vector3d point = pose * (capsule.from_m + i / 200.0 * (capsule.to_m - capsule.from_m));
      const double radius_m = capsule.radius_m + fatter_m;
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_m);
      bool clear = true;
      for_each_cell({map.frame().cell_of(point - reach), map.frame().cell_of(point + reach) + VoxelIndex{1, 1, 1}},
                    [&](const VoxelIndex& cell) {
                      clear =
                          clear && (map.is_clear(cell) || map.frame().box_of(cell).distance_to(point) >= radius_m);
                    });
      if (!clear) {
        return false;
      }
    }
  }
  return true;
}

TEST(Arm, AdmitsExactlyTheConfigurationsWhoseCapsulesTouchClearCellsOnly) {
  std::mt19937_64 engine(1);
  std::size_t admitted = 0;
  std::size_t refused = 0;
  for (int round = 0; round < 6; ++round) {
    const OccupancyMap map = littered_space(engine, 400);
    for (int i = 0; i < 300; ++i) {
      const Joints joints = test::random_joints(arm().chain(), engine);
      if (arm().chain().touches_itself(arm().chain().link_poses(joints))) {
        EXPECT_FALSE(arm().admits_joints(map, joints));
        continue;
      }
      const bool admits = arm().admits_joints(map, joints);
      ASSERT_TRUE(!admits || body_is_clear(map, joints, -2e-4));
      ASSERT_TRUE(admits || !body_is_clear(map, joints, 1e-3));
      ++(admits ? admitted : refused);
    }
  }
  EXPECT_GT(admitted, 200U);
  EXPECT_GT(refused, 200U);
}

TEST(Arm, UnknownCellsAreObstaclesUnlessDeclaredClearAndOccupiedOnesAlwaysAre) {
  ArmOptions options = few_postures();
  options.declared_clear = {{{-1.6, -1.6, -1.0}, {1.6, 1.6, 1.8}}};
  const Arm told(test::tracked_arm(), options);
  const Joints up(5, 0.0);
  OccupancyMap map({.resolution_m = kCell});
  EXPECT_FALSE(arm().admits_joints(map, up));
  EXPECT_TRUE(told.admits_joints(map, up));
  map.set(map.frame().cell_of({0.1, -0.2, 0.9}), Occupancy::Occupied);
  EXPECT_FALSE(told.admits_joints(map, up)) << "the upper arm stands there";
  EXPECT_TRUE(arm().admits_joints(free_space(), up));
  EXPECT_FALSE(told.admits_joints(free_space(), Joints{0.0, 2.5, 0.0, 0.0, 0.0})) << "out of range";
}

TEST(Arm, APoseStandsForOneConfigurationThatBringsTheSensorThere) {
  std::mt19937_64 engine(2);
  std::size_t found = 0;
  std::size_t same = 0;
  std::size_t tried = 0;
  for (int i = 0; i < 1000; ++i) {
    const Joints joints = test::random_joints(arm().chain(), engine);
    if (arm().chain().touches_itself(arm().chain().link_poses(joints))) {
      continue;
    }
    ++tried;
    const Pose pose = arm().sensor_pose(joints);
    const auto configuration = arm().configuration(pose);
    if (!configuration) {
      continue;
    }
    ++found;
    ASSERT_TRUE(arm().chain().in_range(*configuration));
    ASSERT_TRUE(arm().sensor_pose(*configuration).isApprox(pose, 1e-5));
    ASSERT_EQ(*configuration, *arm().configuration(pose));
    double off = 0.0;
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
      off = std::max(off, std::abs(joints[joint] - (*configuration)[joint]));
    }
    same += off < 1e-3 ? 1U : 0U;
  }
  EXPECT_GT(tried, 500U);
  EXPECT_GT(found, tried * 95 / 100);
  EXPECT_GT(same, found * 9 / 10) << "an elbow that bends one way leaves few poses two configurations";
}

TEST(Arm, FacesWhereItIsToldIfItCan) {
  std::mt19937_64 engine(3);
  const OccupancyMap map = free_space();
  std::size_t exact = 0;
  std::size_t admitted = 0;
  for (int i = 0; i < 300; ++i) {
    const Joints joints = test::random_joints(arm().chain(), engine);
    if (!arm().admits_joints(map, joints)) {
      continue;
    }
    const Pose pose = arm().sensor_pose(joints);
    const Pose facing = arm().facing(pose.translation(), 2.0 * optical_axis(pose));
    ASSERT_LT((facing.translation() - pose.translation()).norm(), 1e-5);
    exact += optical_axis(facing).isApprox(optical_axis(pose), 1e-4) ? 1U : 0U;
    admitted += arm().admits(map, facing) ? 1U : 0U;
  }
  EXPECT_GT(admitted, 150U);
  EXPECT_GT(exact, admitted * 9 / 10);
  const Pose nowhere = arm().facing({5.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  EXPECT_FALSE(arm().admits(map, nowhere));
}

TEST(Arm, KnowsAllAdmittedCellsAtOnceAsItKnowsEach) {
  std::mt19937_64 engine(4);
  std::size_t admitted_count = 0;
  for (int round = 0; round < 2; ++round) {
    const OccupancyMap map = littered_space(engine, 300);
    const VoxelBox box{{-8, -14, -4}, {24, 10, 32}};
    const VoxelGrid<std::uint8_t> admitted = arm().admitted_cells(map, box);
    std::size_t compared = 0;
    for_each_cell(box, [&](const VoxelIndex& cell) {
      if ((cell.x + cell.y + cell.z) % 5 == 0) {
        ASSERT_EQ(admitted[cell] != 0, arm().admits_cell(map, cell));
        ++compared;
      }
      admitted_count += admitted[cell];
    });
    EXPECT_GT(compared, 5000U);
    for (const Pose& pose : arm().admitted_poses(map)) {
      const VoxelIndex cell = map.frame().cell_of(pose.translation());
      ASSERT_TRUE(map.is_clear(cell)) << "the sensor is inside the last link";
    }
  }
  EXPECT_GT(admitted_count, 3000U);
}

// If the path keeps a margin, all configurations along it, sampled more finely than in planning, are admitted.
TEST(Arm, PathsAreAdmittedAllTheWayAndTheSameEveryTime) {
  ArmOptions wary = few_postures();
  wary.margin_m = 0.02;
  wary.path_iterations = 200;
  const Arm careful(test::tracked_arm(), wary);
  std::mt19937_64 engine(5);
  std::size_t paths = 0;
  std::size_t around = 0;
  std::size_t configurations = 0;
  for (int round = 0; round < 6; ++round) {
    const OccupancyMap map = littered_space(engine, 60);
    std::vector<Pose> ends;
    while (ends.size() < 6) {
      const Joints joints = test::random_joints(arm().chain(), engine);
      if (careful.admits_joints(map, joints) && careful.admits(map, careful.sensor_pose(joints))) {
        ends.push_back(careful.sensor_pose(joints));
      }
    }
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const auto way = careful.joint_path(map, ends[i - 1], ends[i]);
      ASSERT_EQ(way, careful.joint_path(map, ends[i - 1], ends[i]));
      if (!way) {
        continue;
      }
      ++paths;
      around += way->size() > 2 ? 1U : 0U;
      ASSERT_EQ(way->front(), *careful.configuration(ends[i - 1]));
      ASSERT_EQ(way->back(), *careful.configuration(ends[i]));
      for (std::size_t leg = 1; leg < way->size(); ++leg) {
        for (int step = 0; step <= 150; ++step) {
          Joints joints = (*way)[leg];
          for (std::size_t joint = 0; joint < joints.size(); ++joint) {
            joints[joint] = (*way)[leg - 1][joint] + step / 150.0 * (joints[joint] - (*way)[leg - 1][joint]);
          }
          ASSERT_TRUE(arm().admits_joints(map, joints)) << "leg " << leg << " step " << step;
          ++configurations;
        }
      }
    }
  }
  EXPECT_GT(paths, 15U);
  EXPECT_GT(around, 3U) << "some ways lead around what is in the way";
  EXPECT_GT(configurations, 4000U);
}

TEST(Arm, ThePosesOfAPathJoinItsEndsByAdmittedMotions) {
  std::mt19937_64 engine(6);
  const OccupancyMap map = littered_space(engine, 60);
  std::size_t motions = 0;
  std::size_t admitted = 0;
  for (int i = 0; i < 12; ++i) {
    const Pose from = arm().sensor_pose(test::random_joints(arm().chain(), engine));
    const Pose to = arm().sensor_pose(test::random_joints(arm().chain(), engine));
    if (!arm().admits(map, from) || !arm().admits(map, to)) {
      continue;
    }
    const auto path = arm().path(map, from, to);
    if (!path) {
      continue;
    }
    EXPECT_TRUE(path->front().isApprox(from, 1e-12));
    EXPECT_TRUE(path->back().isApprox(to, 1e-12));
    for (std::size_t leg = 1; leg < path->size(); ++leg) {
      ++motions;
      admitted +=
          arm().admits(map, (*path)[leg]) && arm().admits_motion(map, (*path)[leg - 1], (*path)[leg]) ? 1U : 0U;
      EXPECT_LT(arm().distance_m((*path)[leg - 1], (*path)[leg]), 0.5);
    }
  }
  EXPECT_GT(motions, 50U);
  EXPECT_GT(admitted, motions * 9 / 10) << "but for the few poses that stand for another configuration";
}

TEST(Arm, MayLeaveAPlaceFoundTooTightButNotEnterOne) {
  OccupancyMap map = free_space();
  const Joints up(5, 0.0);
  const Joints aside{0.8, 0.9, 0.3, 0.2, 0.0};
  const Pose tight = arm().sensor_pose(up);
  const Pose wide = arm().sensor_pose(aside);
  map.set(map.frame().cell_of({0.12, -0.2, 0.95}), Occupancy::Occupied);
  ASSERT_FALSE(arm().admits(map, tight));
  ASSERT_TRUE(arm().admits(map, wide));
  EXPECT_TRUE(arm().path(map, tight, wide).has_value());
  EXPECT_FALSE(arm().path(map, wide, tight).has_value());
}

TEST(Arm, BadOptionsAreNamed) {
  const auto complaint = [](const std::function<void(ArmOptions&)>& change) -> std::string {
    ArmOptions options = few_postures();
    change(options);
    try {
      const Arm made(test::tracked_arm(), options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](ArmOptions& o) { o.margin_m = -1.0; }), "ArmOptions::margin_m is -1, must be >= 0");
  EXPECT_EQ(complaint([](ArmOptions& o) { o.joint_step_rad = 0.0; }), "ArmOptions::joint_step_rad is 0, must be > 0");
  EXPECT_EQ(complaint([](ArmOptions& o) { o.pose_step_rad = 0.0; }), "ArmOptions::pose_step_rad is 0, must be > 0");
  EXPECT_EQ(complaint([](ArmOptions& o) { o.path_iterations = 0; }), "ArmOptions::path_iterations is 0, must be > 0");
  EXPECT_EQ(complaint([](ArmOptions& o) { o.guesses = 0; }), "ArmOptions::guesses is 0, must be > 0");
  EXPECT_EQ(complaint([](ArmOptions& o) { o.capability.samples = 0; }),
            "CapabilityMapOptions::samples is 0, must be > 0");
  EXPECT_EQ(complaint([](ArmOptions& o) { o.world_from_base.linear() *= 2.0; }),
            "ArmOptions::world_from_base is not a rigid transform");
}

}  // namespace
}  // namespace vantage
