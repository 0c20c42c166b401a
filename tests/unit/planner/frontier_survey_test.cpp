// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vantage/planner/frontier_survey.hpp>
#include <vantage/robot/free_flyer.hpp>

namespace vantage {
namespace {

RangeSensor rays_all_around() {
  return RangeSensor::spherical(120, 60, 2.0 * std::numbers::pi, std::numbers::pi, 0.0, 6.0);
}

// A closed room of 12 x 12 x 12 free cells; what lies behind its walls is unknown.
OccupancyMap closed_room() {
  OccupancyMap map({.resolution_m = 0.2});
  for_each_cell({{-1, -1, -1}, {13, 13, 13}}, [&](const VoxelIndex& cell) {
    map.set(cell, VoxelBox{{0, 0, 0}, {12, 12, 12}}.contains(cell) ? Occupancy::Free : Occupancy::Occupied);
  });
  return map;
}

FrontierSurvey survey_of(const OccupancyMap& map, const FrontierSurveyOptions& options = {}) {
  return survey_frontiers(map, FreeFlyer({.radius_m = 0.1}), rays_all_around(), pose_looking({1.1, 1.1, 1.1}, 0.0),
                          options, FailedViews());
}

constexpr VoxelBox kOpening{{12, 4, 4}, {13, 6, 6}};  // four cells of the wall at x = 12

TEST(FrontierSurvey, AnOpeningOfFreeCellsIsATarget) {
  OccupancyMap map = closed_room();
  EXPECT_TRUE(survey_of(map).targets.empty());
  for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  const FrontierSurvey survey = survey_of(map);
  EXPECT_EQ(survey.frontier_cells, 4U);
  EXPECT_EQ(survey.targets.size(), 4U);
  for (const FrontierTarget& target : survey.targets) {
    EXPECT_TRUE(kOpening.contains(target.frontier));
    EXPECT_EQ(target.unknown, (target.frontier + VoxelIndex{1, 0, 0}));
    EXPECT_TRUE(survey.reachable.contains(target.viewpoint));
  }
}

// A sensor to which a ray into the open tells nothing goes for the rim of a wide opening first; where nothing touches
// a surface, it takes what there is.
TEST(FrontierSurvey, WithoutNoReturnsTheRimOfAnOpeningComesFirst) {
  constexpr VoxelBox kWide{{12, 3, 3}, {13, 9, 9}};
  OccupancyMap map = closed_room();
  for_each_cell(kWide, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  const FrontierSurvey rim = survey_of(map);
  EXPECT_EQ(rim.targets.size(), 36U - 16U);
  for (const FrontierTarget& target : rim.targets) {
    EXPECT_TRUE(target.frontier.y == 3 || target.frontier.y == 8 || target.frontier.z == 3 || target.frontier.z == 8);
  }
  EXPECT_EQ(survey_of(map, {.surfaces_first = false}).targets.size(), 36U);

  const auto survey_by = [&](const RangeSensor& sensor) {
    return survey_frontiers(map, FreeFlyer({.radius_m = 0.1}), sensor, pose_looking({1.1, 1.1, 1.1}, 0.0), {},
                            FailedViews());
  };
  RangeSensor time_of_flight = rays_all_around();
  time_of_flight.reports_no_return = true;
  EXPECT_EQ(survey_by(time_of_flight).targets.size(), 36U);

  map = OccupancyMap({.resolution_m = 0.2});
  for_each_cell({{0, 0, 0}, {12, 12, 12}}, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  EXPECT_EQ(survey_by(rays_all_around()).targets.size(), 12U * 12U * 12U - 10U * 10U * 10U);
}

// Hit once, missed three times: free by 0.35, which no number of misses makes.
TEST(FrontierSurvey, SightDoesNotPassAContestedWall) {
  OccupancyMap map = closed_room();
  for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set_log_odds(cell, 0.85 - 3 * 0.4); });
  const FrontierSurvey survey = survey_of(map, {.worn_frontiers = true});
  EXPECT_EQ(survey.frontier_cells, 4U);
  EXPECT_TRUE(survey.targets.empty());
  EXPECT_EQ(survey.leftover.unobservable + survey.leftover.unreachable, 4U);
}

// Hit, and missed until it is free for sure: nothing but the map's memory tells it from what was never hit.
TEST(FrontierSurvey, AWornCellIsNoTarget) {
  OccupancyMap map = closed_room();
  for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set_log_odds(cell, -2.0); });
  const FrontierSurvey survey = survey_of(map);
  EXPECT_EQ(survey.frontier_cells, 4U);
  EXPECT_TRUE(survey.targets.empty());
  EXPECT_EQ(survey.leftover.unobservable + survey.leftover.unreachable, 4U);
  EXPECT_EQ(survey_of(map, {.worn_frontiers = true}).targets.size(), 4U);

  // One that never was occupied is a target, also amid worn ones.
  map.set(kOpening.lo + VoxelIndex{1, 0, 0}, Occupancy::Free);
  const FrontierSurvey beyond = survey_of(map);
  EXPECT_EQ(beyond.frontier_cells, 4U);
  ASSERT_EQ(beyond.targets.size(), 1U);
  EXPECT_EQ(beyond.targets.front().frontier, (kOpening.lo + VoxelIndex{1, 0, 0}));
}

TEST(FrontierSurvey, SmallClustersNearAContestedWallAreLeft) {
  OccupancyMap map = closed_room();
  for_each_cell(kOpening, [&](const VoxelIndex& cell) { map.set(cell, Occupancy::Free); });
  map.set_log_odds(VoxelIndex{12, 7, 4}, 0.85 - 3 * 0.4);  // two cells off the opening
  EXPECT_EQ(survey_of(map).leftover.too_small, 4U);
  EXPECT_TRUE(survey_of(map).targets.empty());
  EXPECT_EQ(survey_of(map, {.min_contested_cluster_cells = 4}).targets.size(), 4U);
  EXPECT_EQ(survey_of(map, {.min_cluster_cells = 5, .min_contested_cluster_cells = 1}).leftover.too_small, 4U);
}

}  // namespace
}  // namespace vantage
