// SPDX-License-Identifier: MIT
// Steps of a strategy at the open end of a corridor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <vantage/planner/looks.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/target_view.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr double kCellM = 0.2;
constexpr VoxelBox kCorridor{{0, 0, 0}, {26, 7, 7}};

// Free inside, with walls around it, except at the end, where the unknown begins.
OccupancyMap open_corridor() {
  OccupancyMap map({.resolution_m = kCellM});
  for_each_cell(kCorridor, [&](const VoxelIndex& cell) {
    const bool inside = cell.x > 0 && cell.y > 0 && cell.y < 6 && cell.z > 0 && cell.z < 6;
    map.set(cell, inside ? Occupancy::Free : Occupancy::Occupied);
  });
  map.set({40, 3, 3}, Occupancy::Occupied);  // a part of what stands beyond
  return map;
}

RangeSensor in_all_directions() {
  return RangeSensor::spherical(360, 180, 2 * std::numbers::pi, std::numbers::pi, 0.0, 2.0);
}
RangeSensor camera_ahead() {
  RangeSensor sensor = RangeSensor::pinhole(80, 60, 1.2, 0.9, 0.0, 2.0);
  sensor.reports_no_return = true;
  return sensor;
}

Situation situation_with(const RangeSensor& sensor, const OccupancyMap& map, double x_m) {
  Situation situation({.sensor = sensor, .platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.2})});
  situation.sync(map, pose_looking({x_m, 0.7, 0.7}, std::numbers::pi));  // into the corridor
  return situation;
}

TEST(LookEarly, TakesTheFirstCellOfTheWayThatSeesATarget) {
  const OccupancyMap map = open_corridor();
  const Situation situation = situation_with(in_all_directions(), map, 0.5);
  ASSERT_FALSE(situation.survey().targets.empty());
  std::uint64_t operations = 0;
  for (const FrontierTarget& target : situation.survey().targets) {
    const std::vector<VoxelIndex> way = situation.way_to(target.viewpoint);
    const FrontierTarget early = look_early(situation, way, operations);
    const auto taken = std::find(way.begin(), way.end(), early.viewpoint);
    ASSERT_NE(taken, way.end());
    for (auto cell = way.begin(); cell != way.end() && cell <= taken; ++cell) {
      const Eigen::Vector3d position = situation.reachable().position_in(*cell);
      const bool sees_one = std::any_of(
          situation.survey().targets.begin(), situation.survey().targets.end(), [&](const FrontierTarget& other) {
            const Eigen::Vector3d line = map.frame().centre_of(other.unknown) - position;
            return *cell == other.viewpoint ||
                   (line.norm() <= situation.sensor().resolving_range_m(kCellM) &&
                    sees(map, situation.sensor(), situation.platform().facing(position, line), other.unknown,
                         operations));
          });
      EXPECT_EQ(sees_one, cell == taken);
    }
  }
  EXPECT_GT(operations, 0U);
}

TEST(LookAround, TakesAViewFromWhereTheRobotStandsIfItShowsEnough) {
  const OccupancyMap map = open_corridor();
  std::uint64_t operations = 0;
  const Situation near = situation_with(camera_ahead(), map, 4.1);
  const std::optional<TargetView> view = look_around(near, 0.1, operations);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->view.pose.translation(), near.current().translation());
  EXPECT_GT(optical_axis(view->view.pose).x(), 0.8) << "out of the corridor";
  EXPECT_FALSE(view->unknown.empty());
  EXPECT_FALSE(look_around(near, 1000.0, operations)) << "so much is not to be seen";
  EXPECT_FALSE(look_around(near, std::numeric_limits<double>::infinity(), operations));
  EXPECT_FALSE(look_around(situation_with(camera_ahead(), map, 0.5), 0.1, operations)) << "nothing is in range";
  EXPECT_FALSE(look_around(situation_with(in_all_directions(), map, 4.1), 0.1, operations)) << "it sees all around";
}

TEST(BestLook, SeesItsTargetAndTurnsToWhereMoreIsToBeSeen) {
  const OccupancyMap map = open_corridor();
  const Situation situation = situation_with(camera_ahead(), map, 4.1);
  std::uint64_t operations = 0;
  std::size_t turned = 0;
  for (const FrontierTarget& target : situation.survey().targets) {
    const TargetView best = best_look_at(situation, target, operations);
    EXPECT_NE(std::find(best.unknown.begin(), best.unknown.end(), target.unknown), best.unknown.end());
    EXPECT_EQ(best.view.pose.translation(), situation.reachable().position_in(target.viewpoint));
    const Pose plain = view_of_target(situation.surveyed(), target, operations).view.pose;
    turned += best.view.pose.linear() != plain.linear() ? 1U : 0U;
  }
  EXPECT_GT(situation.survey().targets.size(), 10U);
  EXPECT_GT(turned, 0U);
}

}  // namespace
}  // namespace vantage
