// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <vantage/robot/impl/estimated_motion.hpp>

namespace vantage {
namespace {

using detail::EstimatedMotion;

const MotionModel kMotion{
    .max_speed_m_s = 2.0, .max_acceleration_m_s2 = 3.0, .max_yaw_rate_rad_s = 0.5 * std::numbers::pi};

TEST(EstimatedMotion, IsThatOfTheTrajectory) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::size_t moments = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<Pose> path;
    std::vector<Eigen::Vector3d> corners;
    for (int i = 0; i < 4; ++i) {  // forwards, so that no two moments are at one place
      corners.emplace_back(i * (1.0 + share(random)), share(random), 0.5 * share(random));
      path.push_back(pose_looking(corners.back(), 0.0));
    }
    EstimatedMotion estimate;
    EXPECT_TRUE(estimate.velocity_at(corners.front()).isZero());
    estimate.follow(path, kMotion);
    const auto anywhere = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; };
    const auto way =
        Trajectory::through({corners.front(), Eigen::Vector3d::Zero()}, corners, kMotion, anywhere).value();
    for (int i = 0; i < 20; ++i, ++moments) {
      const MotionState state = way.at(share(random) * way.duration_s());
      EXPECT_LT((estimate.velocity_at(state.position_m) - state.velocity_m_s).norm(), 0.05 * 3.0);
    }
    EXPECT_TRUE(estimate.velocity_at(corners.front() - Eigen::Vector3d(1.0, 0.0, 0.0)).isZero());
  }
  EXPECT_EQ(moments, 1000U);
}

TEST(EstimatedMotion, GoesOnFromOnePathToTheNext) {
  EstimatedMotion estimate;
  const auto looking = [](double x, double y) { return pose_looking({x, y, 0.0}, 0.0); };
  estimate.follow({looking(0.0, 0.0), looking(4.0, 0.0)}, kMotion);
  EXPECT_NEAR(estimate.velocity_at({2.0, 0.0, 0.0}).x(), 2.0, 1e-9);
  estimate.follow({looking(2.0, 0.0), looking(2.0, 3.0)}, kMotion);
  EXPECT_GT(estimate.velocity_at({2.1, 0.0, 0.0}).x(), 1.0);
  EXPECT_TRUE(estimate.velocity_at({2.0, 3.0, 0.0}).norm() < 0.2);
}

}  // namespace
}  // namespace vantage
