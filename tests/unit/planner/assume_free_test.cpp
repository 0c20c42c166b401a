// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vantage/map/height_band.hpp>
#include <vantage/planner/assume_free.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/robot/ground_robot.hpp>

namespace vantage {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCell = 0.1;

// Random bodies at random poses, off the centres of the cells, beside cells that are known.
TEST(AssumeFree, DeclaresTheUnknownCellsThatTheBodyTouchesAndThoseNearTheSensor) {
  std::mt19937 engine(3);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  std::size_t declared = 0;
  std::size_t left = 0;
  std::size_t known = 0;
  for (int trial = 0; trial < 300; ++trial) {
    OccupancyMap map({.resolution_m = kCell});
    const double radius_m = draw(0.05, 0.4);
    const double clearance_m = trial % 2 == 0 ? 0.0 : draw(0.0, 0.6);
    const FreeFlyer flyer({.radius_m = radius_m});
    const Pose pose = pose_looking({draw(-1, 1), draw(-1, 1), draw(-1, 1)}, draw(-kPi, kPi));
    const VoxelIndex here = map.frame().cell_of(pose.translation());
    const VoxelBox around = VoxelBox{here, here + VoxelIndex{1, 1, 1}}.grown(8);
    for_each_cell(around, [&](const VoxelIndex& cell) {
      if (engine() % 9 == 0) {
        map.set(cell, engine() % 2 == 0 ? Occupancy::Free : Occupancy::Occupied);
      }
    });
    const OccupancyMap before = map;
    assume_free(map, flyer, pose, clearance_m);
    for_each_cell(around, [&](const VoxelIndex& cell) {
      if (before.at(cell) != Occupancy::Unknown) {
        EXPECT_EQ(map.log_odds(cell), before.log_odds(cell));
        ++known;
        return;
      }
      const double distance_m = map.frame().box_of(cell).distance_to(pose.translation());
      if (std::abs(distance_m - std::max(radius_m, kCell)) < 1e-6 || std::abs(distance_m - clearance_m) < 1e-6) {
        return;
      }
      const bool is_near = distance_m < std::max({radius_m, kCell, clearance_m});
      EXPECT_EQ(map.at(cell), is_near ? Occupancy::Free : Occupancy::Unknown);
      ++(is_near ? declared : left);
    });
  }
  EXPECT_GT(declared, 20'000U);
  EXPECT_GT(left, 500'000U);
  EXPECT_GT(known, 100'000U);
}

// Wherever a robot starts in an unknown world, it is admitted at that pose afterwards.
TEST(AssumeFree, AdmitsTheRobotWhereItStands) {
  std::mt19937 engine(4);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  std::size_t poses = 0;
  for (; poses < 500; ++poses) {
    const double radius_m = draw(0.01, 0.5);
    const Pose pose = pose_looking({draw(-3, 3), draw(-3, 3), 0.1}, draw(-kPi, kPi));
    const FreeFlyer flyer({.radius_m = radius_m});
    const GroundRobot ground({.radius_m = radius_m});
    for (const Platform* platform : {static_cast<const Platform*>(&flyer), static_cast<const Platform*>(&ground)}) {
      OccupancyMap map({.resolution_m = 0.2});
      EXPECT_FALSE(platform->admits(map, pose));
      assume_free(map, *platform, pose);
      EXPECT_TRUE(platform->admits(map, pose));
    }
  }
  EXPECT_EQ(poses, 500U);
}

TEST(AssumeFree, RefusesAClearanceThatIsNone) {
  OccupancyMap map;
  const FreeFlyer flyer({.radius_m = 0.2});
  for (const double clearance_m : {-0.1, 5.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(assume_free(map, flyer, Pose::Identity(), clearance_m), std::invalid_argument) << clearance_m;
  }
  EXPECT_TRUE(map.bounds().empty());
}

// Outside the declared ball, a body that moves along the optical axis lies within the field of view.
TEST(AssumeFree, AtTheEdgeOfTheClearanceTheBodyIsInTheFieldOfView) {
  const OccupancyMap map({.resolution_m = 0.1});
  EXPECT_EQ(
      start_clearance_m(map, FreeFlyer({.radius_m = 0.3}), RangeSensor::spherical(90, 45, 2 * kPi, kPi, 0.0, 4.0)),
      0.0);
  EXPECT_GE(
      start_clearance_m(map, FreeFlyer({.radius_m = 0.3}), RangeSensor::spherical(90, 45, 2 * kPi, kPi, 0.8, 4.0)),
      0.8)
      << "nothing is seen within the minimum range";
  std::mt19937 engine(5);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  std::size_t sensors = 0;
  for (; sensors < 500; ++sensors) {
    const double body_m = draw(0.0, 0.4);
    const double radius_m = std::max(body_m, map.resolution_m());  // a cell stays clear
    const RangeSensor sensor = RangeSensor::pinhole(64, 48, draw(0.6, 2.0), draw(0.6, 2.0), draw(0.0, 0.5), 6.0);
    const double clearance_m = start_clearance_m(map, FreeFlyer({.radius_m = body_m}), sensor);
    ASSERT_LT(clearance_m, 5.0);
    // A rim of the swept body that touches the declared ball from outside.
    const double ahead_m = std::sqrt(clearance_m * clearance_m - radius_m * radius_m) + 1e-9;
    for (const Eigen::Vector3d& rim :
         {Eigen::Vector3d(radius_m, 0, ahead_m), Eigen::Vector3d(-radius_m, 0, ahead_m),
          Eigen::Vector3d(0, radius_m, ahead_m), Eigen::Vector3d(0, -radius_m, ahead_m)}) {
      EXPECT_TRUE(sensor.in_view(rim)) << rim.transpose();
      EXPECT_GE(rim.norm(), sensor.min_range_m);
    }
  }
  EXPECT_EQ(sensors, 500U);
}

// Outside of the declared disc, the floor one step below the band is in view, in every direction to which a level
// sensor can be turned; well inside of it, it is not.
TEST(StartFloor, ReachesToWhereTheSensorSeesTheFloor) {
  std::mt19937 engine(6);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  std::size_t sensors = 0;
  for (; sensors < 500; ++sensors) {
    const double cell_m = draw(0.05, 0.2);
    const double above_m = draw(0.3, 1.0);  // the sensor above a floor one step below the band
    const HeightBand band(
        {.resolution_m = cell_m},
        {.min_height_m = 0.1, .max_height_m = 1.5, .sensor_height_m = above_m - 0.1, .step_height_m = 0.2});
    const double tall_rad = draw(0.6, 1.6);
    const RangeSensor sensor = sensors % 2 == 0
                                   ? RangeSensor::pinhole(64, 48, draw(0.6, 2.0), tall_rad, draw(0.0, 2.0), 30.0)
                                   : RangeSensor::spherical(64, 48, 2 * kPi, tall_rad, draw(0.0, 2.0), 30.0);
    const double floor_m = start_floor_m(band, GroundRobot({.radius_m = 0.2}), sensor);
    EXPECT_GE(floor_m, 0.2);
    const double corner_m = above_m / std::tan(0.5 * tall_rad) / std::cos(0.5 * sensor.horizontal_angle_rad());
    EXPECT_LE(floor_m, std::max({0.3, sensor.min_range_m, 1.1 * std::abs(corner_m)}) + 2.0 * cell_m);
    for (int place = 0; place < 40; ++place) {
      const double azimuth = draw(-0.49, 0.49) * sensor.horizontal_angle_rad();
      const auto floor_at = [&](double range_m) {
        return Eigen::Vector3d(range_m * std::sin(azimuth), above_m, range_m * std::cos(azimuth));
      };
      EXPECT_TRUE(sensor.in_view(floor_at(floor_m)));
      EXPECT_GE(floor_at(floor_m).norm(), sensor.min_range_m);
    }
    const double seen_from_m = above_m / std::tan(0.5 * tall_rad);
    EXPECT_FALSE(sensor.in_view({0.0, above_m, 0.9 * seen_from_m}));
  }
  EXPECT_EQ(sensors, 500U);
}

TEST(StartFloor, NamesTheOptionIfTheSensorNeverSeesTheFloor) {
  const HeightBand band({.resolution_m = 0.1}, {.sensor_height_m = 0.5});
  for (const RangeSensor& sensor : {RangeSensor::spherical(360, 1, 2 * kPi, 0.001, 0.0, 20.0),  // a plane of rays
                                    RangeSensor::pinhole(64, 48, 1.0, 0.1, 0.0, 4.0)}) {        // ends above it
    try {
      (void)start_floor_m(band, GroundRobot({.radius_m = 0.2}), sensor);
      ADD_FAILURE() << "no error";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(
          std::string(error.what()),
          "HeightBandOptions::needs_floor: the lowest rays of the sensor do not reach a floor 0.650000 m below it, "
          "one step below the band");
    }
  }
}

}  // namespace
}  // namespace vantage
