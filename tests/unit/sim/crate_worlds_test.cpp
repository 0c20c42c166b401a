// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vantage/sim/triangle_scene.hpp>
#include <vantage/sim/truth.hpp>
#include <vantage/sim/world.hpp>

namespace vantage {
namespace {

const VoxelFrame kCells{0.025};

struct Escapes {
  std::size_t tried = 0;
  std::size_t escaped = 0;
};

/// Casts rays in all directions from inside a hollow box of `outside` cells and counts those that leave it.
Escapes rays_out_of(const TriangleScene& scene, const VoxelBox& outside) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.1, 0.9);
  const Box box = kCells.box_of(outside);
  const Box hollow = kCells.box_of(outside.grown(-1));
  Escapes count;
  for (; count.tried < 2000; ++count.tried) {
    const Eigen::Vector3d at =
        hollow.min + Eigen::Vector3d(share(engine), share(engine), share(engine)).cwiseProduct(hollow.extent());
    const Eigen::Vector3d direction = Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
    const auto hit_m = scene.hit_distance(at, direction, 10.0);
    count.escaped += !hit_m || !box.contains(at + *hit_m * direction) ? 1U : 0U;
  }
  return count;
}

TEST(CrateWorlds, OpenBoxesAreOpenAboveAndTheBlockIsSolid) {
  const World world = World::by_name("crates-open");
  const TriangleScene scene(world.mesh);
  const auto below = [&](double x, double y) { return 2.0 - *scene.hit_distance({x, y, 2.0}, {0, 0, -1}, 5.0); };
  EXPECT_NEAR(below(0.9, -0.2), 0.0225, 1e-5) << "the bottom of one box";
  EXPECT_NEAR(below(0.9, 0.3), 0.0225, 1e-5) << "the bottom of the other";
  EXPECT_NEAR(below(0.9, -0.55), 0.4225, 1e-5) << "the top of the block";
  EXPECT_NEAR(below(0.2, -1.0), -0.0025, 1e-5) << "the floor";
  for (const VoxelBox& box : {VoxelBox{{24, -18, 0}, {44, 2, 10}}, VoxelBox{{22, 2, 0}, {44, 22, 12}}}) {
    const Escapes rays = rays_out_of(scene, box);
    EXPECT_GT(rays.escaped, rays.tried / 10);
    EXPECT_LT(rays.escaped, rays.tried / 2) << "its walls and its bottom hold the rest";
  }
}

TEST(CrateWorlds, NothingSeesIntoClosedBoxesAndLittleIntoTheOthers) {
  const World world = World::by_name("crates-closed");
  const TriangleScene scene(world.mesh);
  for (const VoxelBox& box : {VoxelBox{{26, -24, 0}, {44, 0, 14}}, VoxelBox{{26, 0, 0}, {44, 24, 14}}}) {
    EXPECT_EQ(rays_out_of(scene, box).escaped, 0U);
  }
  for (const VoxelBox& box : {VoxelBox{{32, -18, 14}, {44, -4, 24}}, VoxelBox{{32, 6, 14}, {44, 20, 24}},
                              VoxelBox{{16, -6, 0}, {26, 6, 8}}}) {
    const Escapes rays = rays_out_of(scene, box);
    EXPECT_GT(rays.escaped, 20U);
    EXPECT_LT(rays.escaped, rays.tried / 8);
  }
}

TEST(CrateWorlds, AreMadeOfCellsThatAMapTellsApart) {
  for (const char* name : {"crates-open", "crates-closed"}) {
    const World world = World::by_name(name);
    EXPECT_EQ(world.name, name);
    EXPECT_EQ(world.mesh.triangles, World::by_name(name, {.seed = 9}).mesh.triangles);
    const Truth truth(world, kCells.size_m, world.region);
    const OccupancyMap::Counts counts = truth.map().counts();
    EXPECT_EQ(counts.free + counts.occupied, 66U * 100U * 61U) << name;
    constexpr std::size_t kFloorAndWall = 66U * 100U + 100U * 60U;
    EXPECT_GT(counts.occupied, kFloorAndWall + 3000U) << name << ": and the crates";
    EXPECT_LT(counts.occupied, kFloorAndWall + 20'000U) << name;
    ASSERT_TRUE(world.searched);
    EXPECT_TRUE(world.searched->contains(kCells.centre_of({35, -20, 12}))) << name << ": the crates are searched";
    EXPECT_FALSE(world.searched->contains(kCells.centre_of({8, 0, 10}))) << name << ": the robot's place is not";
    EXPECT_EQ(truth.at({0, 0, -1}), CellTruth::Occupied) << name << ": the floor";
    EXPECT_EQ(truth.at({0, 0, 0}), CellTruth::Free) << name;
    for (int z = 0; z < 60; ++z) {
      for (int y = -12; y < 12; ++y) {
        ASSERT_EQ(truth.at({8, y, z}), CellTruth::Free) << name << ": where the robot stands";
      }
    }
  }
}

}  // namespace
}  // namespace vantage
