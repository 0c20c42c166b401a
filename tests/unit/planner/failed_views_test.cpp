// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <stdexcept>
#include <vantage/planner/failed_views.hpp>

namespace vantage {
namespace {

const VoxelIndex kUnknown{5, 5, 5};

OccupancyMap slab_before_the_unknown() {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{0, 0, 0}, {5, 10, 10}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  return map;
}

// What a host does: the planner announces a view, the host takes it, the planner looks at the map again.
void view_in_vain(FailedViews& failed, OccupancyMap& map, const Pose& goal) {
  failed.expect(map, goal, {kUnknown});
  map.set_log_odds(VoxelIndex{0, 0, 0}, -1.0);  // a new revision that tells nothing
  failed.review(map, goal);
}

TEST(FailedViews, GivesACellUpAfterViewsFromAsManyPlacesAsItHasPatience) {
  for (const int patience : {1, 2, 3}) {
    OccupancyMap map = slab_before_the_unknown();
    FailedViews failed(patience);
    for (int view = 1; view <= patience; ++view) {
      EXPECT_FALSE(failed.gave_up(kUnknown)) << view;
      const VoxelIndex from{2, 5, view};
      const Pose goal = pose_looking(map.frame().centre_of(from), 0.0);
      EXPECT_FALSE(failed.failed_from(kUnknown, from));
      view_in_vain(failed, map, goal);
      view_in_vain(failed, map, goal);  // the same place again tells nothing new
      EXPECT_TRUE(failed.failed_from(kUnknown, from));
      EXPECT_EQ(failed.gave_up(kUnknown), view == patience) << view;
    }
    for (const VoxelIndex& other : {VoxelIndex{0, 0, 1}, {128, 0, 0}, {0, -128, 0}, {0, 0, 64}, {64, 0, 0}}) {
      EXPECT_FALSE(failed.failed(kUnknown + other));
      EXPECT_FALSE(failed.gave_up(kUnknown + other));
    }
  }
}

TEST(FailedViews, FailsTowardsAllThatLieInTheSameDirection) {
  OccupancyMap map = slab_before_the_unknown();
  FailedViews failed(2);
  EXPECT_FALSE(failed.failed(kUnknown));
  EXPECT_FALSE(failed.failed_towards(kUnknown, {2, 5, 5}, 0.5));
  view_in_vain(failed, map, pose_looking(map.frame().centre_of({2, 5, 5}), 0.0));
  EXPECT_TRUE(failed.failed(kUnknown));
  for (const double within_rad : {0.0, 0.3, 0.5, 1.0}) {
    EXPECT_TRUE(failed.failed_towards(kUnknown, {2, 5, 5}, within_rad));
    EXPECT_EQ(failed.failed_towards(kUnknown, {-5, 9, 5}, within_rad), within_rad > std::atan(0.4));
    EXPECT_EQ(failed.failed_towards(kUnknown, {3, 5, 3}, within_rad), within_rad > std::atan(1.0));
    EXPECT_FALSE(failed.failed_towards(kUnknown, {8, 5, 5}, within_rad)) << "the other side";
    EXPECT_FALSE(failed.failed_towards({5, 5, 6}, {2, 5, 5}, within_rad));
  }
}

TEST(FailedViews, RemembersTheViewsThatFailed) {
  OccupancyMap map = slab_before_the_unknown();
  FailedViews failed;
  const VoxelIndex place{2, 5, 5};
  const Eigen::Vector3d position = map.frame().centre_of(place);
  for (const double yaw_rad : {0.0, 1.0, 2.0}) {
    const Pose announced = pose_looking(position, yaw_rad);
    failed.expect(map, announced, {kUnknown});
    failed.review(map, announced);  // before there is a scan
    map.set_log_odds(VoxelIndex{0, 0, 0}, -1.0);
    const Pose taken = pose_looking(position + Eigen::Vector3d(0.02, 0.0, 0.0), yaw_rad + 0.05);
    failed.review(map, taken);
    failed.review(map, taken);
    const std::span<const Pose> views = failed.views_from(place);
    ASSERT_EQ(views.size(), static_cast<std::size_t>(yaw_rad) + 1U);
    EXPECT_EQ(views.back().matrix(), taken.matrix());
  }
  EXPECT_TRUE(failed.views_from({2, 5, 6}).empty());

  const VoxelIndex elsewhere{2, 5, 7};
  const Pose succeeds = pose_looking(map.frame().centre_of(elsewhere), 0.0);
  failed.expect(map, succeeds, {kUnknown});
  map.set(kUnknown, Occupancy::Free);
  failed.review(map, succeeds);
  EXPECT_TRUE(failed.views_from(elsewhere).empty());
}

TEST(FailedViews, CountsOnlyFromTheGoalAndOnlyANewMap) {
  OccupancyMap map = slab_before_the_unknown();
  const Pose goal = pose_looking({0.5, 1.1, 1.1}, 0.0);
  FailedViews failed(1);
  failed.review(map, goal);
  failed.expect(map, goal, {kUnknown});
  failed.review(map, goal);
  EXPECT_FALSE(failed.gave_up(kUnknown)) << "the map is what it was: no view was taken";
  map.set_log_odds(VoxelIndex{0, 0, 0}, -1.0);
  failed.review(map, pose_looking({0.75, 1.1, 1.1}, 0.0));  // more than a cell away
  failed.review(map, pose_looking({0.5, 1.1, 1.1}, 0.3));   // more than ten degrees off
  EXPECT_FALSE(failed.gave_up(kUnknown)) << "the sensor is elsewhere";
  map.set_log_odds(VoxelIndex{0, 0, 0}, -1.2);
  failed.review(map, pose_looking({0.55, 1.1, 1.05}, 0.1));
  EXPECT_TRUE(failed.gave_up(kUnknown)) << "as near as robots come to their goals";
  EXPECT_THROW(FailedViews(0), std::invalid_argument);
}

TEST(FailedViews, WhatAViewHopedForFailsOnlyIfItResolvesNoneOfIt) {
  constexpr VoxelIndex kOther{5, 6, 6};
  const Pose goal = pose_looking({0.5, 1.1, 1.1}, 0.0);
  for (const bool one_resolved : {false, true}) {
    OccupancyMap map = slab_before_the_unknown();
    FailedViews failed(1);
    failed.expect(map, goal, {kUnknown}, {kOther, {6, 6, 6}});
    map.set(one_resolved ? VoxelIndex{6, 6, 6} : VoxelIndex{0, 0, 0}, Occupancy::Free);
    failed.review(map, goal);
    EXPECT_TRUE(failed.gave_up(kUnknown));
    EXPECT_EQ(failed.gave_up(kOther), !one_resolved);
  }
}

TEST(FailedViews, ForgetsWhenMoreOfTheNeighboursBecomesKnownNotWhenTheyChangeTheirMind) {
  OccupancyMap map = slab_before_the_unknown();
  FailedViews failed(1);
  view_in_vain(failed, map, pose_looking({0.5, 1.1, 1.1}, 0.0));
  ASSERT_TRUE(failed.gave_up(kUnknown));
  for (const Occupancy mind : {Occupancy::Occupied, Occupancy::Free, Occupancy::Occupied}) {
    map.set({4, 5, 5}, mind);
    failed.review(map, Pose::Identity());
    EXPECT_TRUE(failed.gave_up(kUnknown));
  }
  map.set({5, 6, 5}, Occupancy::Free);
  failed.review(map, Pose::Identity());
  EXPECT_FALSE(failed.gave_up(kUnknown));
}

TEST(FailedViews, KeepsNothingOfCellsThatBecameKnown) {
  OccupancyMap map = slab_before_the_unknown();
  FailedViews failed(1);
  view_in_vain(failed, map, pose_looking({0.5, 1.1, 1.1}, 0.0));
  EXPECT_EQ(failed.size(), 1U);
  map.set(kUnknown, Occupancy::Occupied);
  failed.review(map, Pose::Identity());
  EXPECT_EQ(failed.size(), 0U);
}

}  // namespace
}  // namespace vantage
