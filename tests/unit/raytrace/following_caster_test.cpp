// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <stdexcept>
#include <vantage/raytrace/following_caster.hpp>

namespace vantage {
namespace {

TEST(FollowingCaster, FollowsOneMapAndBeginsAnewWithAnother) {
  const RangeSensor sensor = RangeSensor::pinhole(40, 40, 0.9, 0.9, 0.0, 3.0);
  const VoxelIndex cell{3, 4, 5};
  OccupancyMap map({.resolution_m = 0.1});
  FollowingCaster looking;
  EXPECT_TRUE(looking.follow(map, sensor));
  EXPECT_EQ(looking.caster().at(cell), Occupancy::Unknown);

  map.set(cell, Occupancy::Occupied);
  EXPECT_FALSE(looking.follow(map, sensor)) << "the same map, which has changed";
  EXPECT_EQ(looking.caster().at(cell), Occupancy::Occupied);
  const std::size_t rays = looking.rays().size();

  OccupancyMap coarse({.resolution_m = 0.2});
  coarse.set(cell, Occupancy::Free);
  EXPECT_TRUE(looking.follow(coarse, sensor));
  EXPECT_EQ(looking.caster().at(cell), Occupancy::Free);
  EXPECT_LT(looking.rays().size(), rays) << "larger cells ask for fewer rays";

  map = coarse;
  map.set(cell, Occupancy::Occupied);
  EXPECT_TRUE(looking.follow(map, sensor)) << "a copy changes on its own";
  EXPECT_EQ(looking.caster().at(cell), Occupancy::Occupied);
}

TEST(FollowingCaster, BeginsAnewAfterAMapThatCannotBeLookedAt) {
  const RangeSensor sensor = RangeSensor::pinhole(40, 40, 0.9, 0.9, 0.0, 3.0);
  OccupancyMap map;
  map.set({1, 2, 3}, Occupancy::Occupied);
  OccupancyMap torn = map;
  torn.set({40000, 40000, 40000}, Occupancy::Free);
  FollowingCaster looking;
  EXPECT_TRUE(looking.follow(map, sensor));
  EXPECT_THROW((void)looking.follow(torn, sensor), std::length_error);
  EXPECT_TRUE(looking.follow(map, sensor)) << "nothing is left of the map before";
  EXPECT_EQ(looking.caster().at({1, 2, 3}), Occupancy::Occupied);
}

}  // namespace
}  // namespace vantage
