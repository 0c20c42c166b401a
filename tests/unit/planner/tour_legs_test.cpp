// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <vantage/planner/situation.hpp>
#include <vantage/planner/tour_planner.hpp>
#include <vantage/robot/free_flyer.hpp>
#include <vector>

#include <vantage/planner/impl/tour_legs.hpp>

namespace vantage {
namespace {

using detail::BlockWays;
using detail::TourLegs;
using detail::TourView;

const MotionModel kMotion = TourPlanner::default_motion();

// A free cube about the robot.
class LegsInTheOpen : public ::testing::Test {
 protected:
  LegsInTheOpen()
      : map_({.resolution_m = 0.2}),
        situation_({.sensor = RangeSensor::pinhole(40, 30, std::numbers::pi / 2.0, std::numbers::pi / 3.0, 0.0, 5.0),
                    .platform = std::make_shared<FreeFlyer>(FreeFlyerOptions{.radius_m = 0.15}),
                    .motion = kMotion}),
        ways_(map_.frame(), 4) {
    for_each_cell({{-25, -25, -5}, {26, 26, 6}}, [&](const VoxelIndex& cell) { map_.set(cell, Occupancy::Free); });
    situation_.sync(map_, pose_looking({0.1, 0.1, 0.1}, 0.0));
    ways_.follow([this](const VoxelIndex& brick) {
      const BrickPlane* const cells = situation_.reachable().find(brick);
      return cells == nullptr ? BrickPlane{} : *cells;
    });
    for (const VoxelIndex& place : {VoxelIndex{10, 0, 0}, VoxelIndex{-10, 0, 0}, VoxelIndex{0, 10, 0}}) {
      views_.push_back({place, pose_looking(map_.frame().centre_of(place), 0.0), {}});
    }
  }
  [[nodiscard]] double first_leg(TourCost cost, const Eigen::Vector3d& velocity_m_s, std::size_t to) {
    const std::vector<double> from_start = ways_.lengths_from(*situation_.reachable().start());
    return TourLegs(situation_, cost, velocity_m_s, ways_, from_start, views_).between(views_.size(), to);
  }

  OccupancyMap map_;
  Situation situation_;
  BlockWays ways_;
  std::vector<TourView> views_;  // two metres ahead, behind and to the left
};

// Ways are computed on blocks of 0.8 m, so they are off by a part of that.
TEST_F(LegsInTheOpen, AtRestAllDirectionsCostAboutTheSame) {
  for (std::size_t to = 0; to < views_.size(); ++to) {
    EXPECT_NEAR(first_leg(TourCost::Path, Eigen::Vector3d::Zero(), to), 2.0, 0.3);
    EXPECT_NEAR(first_leg(TourCost::Time, Eigen::Vector3d::Zero(), to), 1.0, 0.15);
  }
}

// From 2 m/s with 3 m/s^2 the robot stops within 2/3 s and 2/3 m.
TEST_F(LegsInTheOpen, AMovingRobotIsSoonerAheadThanBehind) {
  const Eigen::Vector3d rest = Eigen::Vector3d::Zero();
  const Eigen::Vector3d forwards(2.0, 0.0, 0.0);
  const auto costs_more = [&](std::size_t to) {
    return first_leg(TourCost::Time, forwards, to) - first_leg(TourCost::Time, rest, to);
  };
  EXPECT_NEAR(costs_more(0), -1.0 / 3.0, 1e-3);
  EXPECT_NEAR(costs_more(1), 2.0 / 3.0 + 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(first_leg(TourCost::Time, forwards, 2), 2.0 / 3.0 * (1.0 + std::numbers::sqrt2), 1e-2);
  for (std::size_t to = 0; to < views_.size(); ++to) {
    EXPECT_EQ(first_leg(TourCost::Path, forwards, to), first_leg(TourCost::Path, rest, to));
  }
}

}  // namespace
}  // namespace vantage
