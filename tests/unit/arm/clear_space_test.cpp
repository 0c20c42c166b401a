// SPDX-License-Identifier: MIT
#include "arm/clear_space.hpp"

#include <gtest/gtest.h>

#include <random>

#include <vantage/robot/impl/swept_sphere.hpp>

namespace vantage::detail {
namespace {

constexpr VoxelFrame kFrame{0.05};

VoxelGrid<std::uint8_t> littered_grid(std::mt19937_64& engine, int one_in) {
  VoxelGrid<std::uint8_t> clear({{-14, -9, 3}, {17, 12, 30}}, 1);
  for (std::uint8_t& cell : clear.values()) {
    cell = engine() % static_cast<unsigned>(one_in) == 0 ? 0 : 1;
  }
  return clear;
}

Eigen::Vector3d random_place(const VoxelBox& box, std::mt19937_64& engine) {
  const auto between = [&](std::int32_t lo, std::int32_t hi) {
    return kFrame.size_m * std::uniform_real_distribution<double>(lo + 1, hi - 1)(engine);
  };
  return {between(box.lo.x, box.hi.x), between(box.lo.y, box.hi.y), between(box.lo.z, box.hi.z)};
}

// By definition, sweep by sweep: capsules, spheres at rest and points of various radii, with few and many obstacles.
TEST(ClearSpace, FindsAnObstacleExactlyWhereTheSweptSphereTouchesOne) {
  std::mt19937_64 engine(1);
  std::size_t clear_count = 0;
  std::size_t obstacles = 0;
  for (const int one_in : {20, 200, 2000, 20000}) {
    const VoxelGrid<std::uint8_t> grid = littered_grid(engine, one_in);
    const ClearSpace space(kFrame, grid);
    const auto is_clear = [&](const VoxelIndex& cell) { return grid.value_or(cell, 0) != 0; };
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d from = random_place(grid.box(), engine);
      const double share = i % 5 == 0 ? 0.0 : std::uniform_real_distribution<double>(0.0, 1.0)(engine);
      const Eigen::Vector3d to = from + share * (random_place(grid.box(), engine) - from);
      const double radius_m = i % 7 == 0 ? 0.0 : std::uniform_real_distribution<double>(0.0, 0.2)(engine);
      const auto found = space.obstacle(from, to, radius_m);
      ASSERT_EQ(!found, swept_sphere_is_clear(kFrame, from, to, radius_m, is_clear));
      if (found) {
        ASSERT_FALSE(is_clear(*found));
        ASSERT_LE(distance_to_segment(kFrame.box_of(*found), from, to), radius_m + 1e-9);
        ASSERT_EQ(found, space.obstacle(from, to, radius_m));
      }
      ++(found ? obstacles : clear_count);
    }
  }
  EXPECT_GT(clear_count, 2000U);
  EXPECT_GT(obstacles, 2000U);
}

TEST(ClearSpace, NothingBeyondTheGridIsClear) {
  const ClearSpace space(kFrame, VoxelGrid<std::uint8_t>({{0, 0, 0}, {4, 4, 4}}, 1));
  EXPECT_TRUE(space.is_clear({3, 3, 3}));
  EXPECT_FALSE(space.is_clear({4, 3, 3}));
  EXPECT_FALSE(space.obstacle({0.05, 0.05, 0.05}, {0.15, 0.15, 0.15}, 0.04).has_value());
  EXPECT_TRUE(space.obstacle({0.05, 0.05, 0.05}, {0.15, 0.15, 0.15}, 0.06).has_value());
  EXPECT_TRUE(space.obstacle({0.05, 0.05, 0.05}, {0.25, 0.15, 0.15}, 0.01).has_value());
}

}  // namespace
}  // namespace vantage::detail
