// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/frontier_survey.hpp>
#include <vantage/view/frontier_surveyor.hpp>

namespace vantage {
namespace {

RangeSensor rays_all_around() {
  return RangeSensor::spherical(120, 60, 2.0 * std::numbers::pi, std::numbers::pi, 0.0, 6.0);
}

// A closed room of 12 x 12 x 12 free cells; the space behind the walls is unknown.
OccupancyMap closed_room() {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{-1, -1, -1}, {13, 13, 13}}, [&](const VoxelIndex& cell) {
    map.set(cell, VoxelBox{{0, 0, 0}, {12, 12, 12}}.contains(cell) ? Occupancy::Free : Occupancy::Occupied);
  });
  return map;
}

FrontierSurvey survey_of(const OccupancyMap& map, const RangeSensor& sensor = rays_all_around()) {
  return survey_frontiers(map, FreeFlyer({.radius_m = 0.1, .margin_m = 0.0}), sensor,
                          pose_looking({1.1, 1.1, 1.1}, 0.0), {}, TriedViews(sensor));
}

constexpr VoxelBox kOpening{{12, 4, 4}, {13, 6, 6}};  // four cells of the wall at x = 12

TEST(FrontierSurvey, AnOpeningOfFreeCellsIsATarget) {
  OccupancyMap map = closed_room();
  EXPECT_TRUE(survey_of(map).targets.empty());
  for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  const FrontierSurvey survey = survey_of(map);
  EXPECT_EQ(survey.frontier_cells, 4U);
  EXPECT_EQ(survey.targets.size(), 4U);
  const ReachableSpace reachable(map, FreeFlyer({.radius_m = 0.1, .margin_m = 0.0}),
                                 pose_looking({1.1, 1.1, 1.1}, 0.0));
  for (const FrontierTarget& target : survey.targets) {
    EXPECT_TRUE(kOpening.contains(target.frontier));
    EXPECT_EQ(target.unknown, (target.frontier + VoxelIndex{1, 0, 0}));
    EXPECT_TRUE(reachable.contains(target.viewpoint));
  }
}

// If rays into open space teach the sensor nothing, the rim of a wide opening comes first. Without any surface, all
// targets remain.
TEST(FrontierSurvey, WithoutNoReturnsTheRimOfAnOpeningComesFirst) {
  constexpr VoxelBox kWide{{12, 3, 3}, {13, 9, 9}};
  OccupancyMap map = closed_room();
  for_each_cell(kWide, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  const FrontierSurvey rim = survey_of(map);
  EXPECT_EQ(rim.targets.size(), 36U - 16U);
  for (const FrontierTarget& target : rim.targets) {
    EXPECT_TRUE(target.frontier.y == 3 || target.frontier.y == 8 || target.frontier.z == 3 || target.frontier.z == 8);
  }
  RangeSensor time_of_flight = rays_all_around();
  time_of_flight.reports_no_return = true;
  EXPECT_EQ(survey_of(map, time_of_flight).targets.size(), 36U);

  map = OccupancyMap({.resolution_m = 0.2});
  for_each_cell({{0, 0, 0}, {12, 12, 12}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  EXPECT_EQ(survey_of(map).targets.size(), 12U * 12U * 12U - 10U * 10U * 10U);
}

// Hit, then missed until it is free, or certainly free: its earlier state does not matter. Free with log-odds -0.35,
// hit once and missed three times, is contested: a body does not pass it, sight does.
TEST(FrontierSurvey, AWornCellIsATargetLikeAnyOther) {
  for (const double log_odds : {-2.0, 0.85 - 3 * 0.4}) {
    OccupancyMap map = closed_room();
    for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set_log_odds(cell, log_odds); });
    const FrontierSurvey survey = survey_of(map);
    EXPECT_EQ(survey.frontier_cells, 4U) << log_odds;
    EXPECT_EQ(survey.targets.size(), 4U) << log_odds;
  }
}

// A single cell of an opening is enough, even a contested one.
TEST(FrontierSurvey, NoClusterIsTooSmall) {
  OccupancyMap map = closed_room();
  const VoxelIndex contested = kOpening.lo + VoxelIndex{0, 2, 0};
  map.set(kOpening.lo, Occupancy::Free);
  map.set_log_odds(contested, 0.85 - 3 * 0.4);
  const FrontierSurvey survey = survey_of(map);
  ASSERT_EQ(survey.targets.size(), 2U);
  EXPECT_EQ(survey.targets.front().frontier, kOpening.lo);
  EXPECT_EQ(survey.targets.back().frontier, contested);
}

// Counts by cause: looked at in vain from enough places, unreachable for a large body, unobservable for a narrow
// view.
TEST(FrontierSurvey, WhatIsLeftIsCountedByItsCause) {
  OccupancyMap map = closed_room();
  for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  const RangeSensor sensor = rays_all_around();
  const Pose current = pose_looking({1.1, 1.1, 1.1}, 0.0);
  TriedViews tried(sensor);
  tried.review(map, current);
  for_each_cell(kOpening, [&](const VoxelIndex& cell) {
    tried.in_vain(map, cell + VoxelIndex{1, 0, 0}, {9, 5, 5});
    tried.in_vain(map, cell + VoxelIndex{1, 0, 0}, {5, 10, 5});
  });
  const FreeFlyer flyer({.radius_m = 0.1, .margin_m = 0.0});
  EXPECT_EQ(survey_frontiers(map, flyer, sensor, current, {}, tried).leftover, (Leftover{.in_vain = 4}));

  // A body that stays near the floor, with a horizontal field of view.
  const RangeSensor level = RangeSensor::spherical(120, 2, 2.0 * std::numbers::pi, 0.01, 0.0, 6.0);
  const FreeFlyer low({.radius_m = 0.1, .max_height_m = 0.25, .margin_m = 0.0, .yaw_only = true});
  const Pose below = pose_looking({1.1, 1.1, 0.1}, 0.0);
  const auto left = [&] { return survey_frontiers(map, low, level, below, {}, TriedViews(level)).leftover; };
  EXPECT_EQ(left(), (Leftover{.unreachable = 4}));
  map = closed_room();
  map.set({12, 4, 1}, Occupancy::Free);
  EXPECT_EQ(left(), (Leftover{.unobservable = 1}));
  map.set({12, 4, 0}, Occupancy::Free);
  EXPECT_EQ(left(), (Leftover{.unobservable = 1})) << "and one target";
}

}  // namespace
}  // namespace vantage
