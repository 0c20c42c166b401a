// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>
#include <vantage/geometry/pose.hpp>

namespace vantage {
namespace {

TEST(Orthonormalised, LeavesARigidTransformAsItIs) {
  std::mt19937 engine(3);
  std::normal_distribution<double> draw;
  for (int i = 0; i < 100; ++i) {
    Pose pose(Eigen::Quaterniond(draw(engine), draw(engine), draw(engine), draw(engine)).normalized());
    pose.translation() = Eigen::Vector3d(draw(engine), draw(engine), draw(engine));
    EXPECT_EQ(orthonormalised(pose).matrix(), pose.matrix());
  }
}

// Rotations slightly turned from the result must be further away.
TEST(Orthonormalised, FindsTheNearestRotationOfOneWrittenWithFewDigits) {
  std::mt19937 engine(4);
  std::normal_distribution<double> draw;
  int mended = 0;
  for (int i = 0; i < 100; ++i) {
    Pose pose(Eigen::Quaterniond(draw(engine), draw(engine), draw(engine), draw(engine)).normalized());
    pose.matrix() = (1e4 * pose.matrix()).array().round() / 1e4;
    pose.translation() = Eigen::Vector3d(draw(engine), draw(engine), draw(engine));
    mended += is_rigid(pose) ? 0 : 1;
    const Pose rigid = orthonormalised(pose);
    EXPECT_TRUE(is_rigid(rigid, 1e-12) || is_rigid(pose));
    EXPECT_EQ(rigid.translation(), pose.translation());
    const double off = (rigid.linear() - pose.linear()).norm();
    EXPECT_LT(off, 3e-4);
    for (int turn = 0; turn < 10; ++turn) {
      const Eigen::Vector3d axis = Eigen::Vector3d(draw(engine), draw(engine), draw(engine)).normalized();
      const Eigen::Matrix3d other = Eigen::AngleAxisd(1e-4, axis) * rigid.linear();
      EXPECT_TRUE(is_rigid(pose) || (other - pose.linear()).norm() > off);
    }
  }
  EXPECT_GE(mended, 90);
}

TEST(Orthonormalised, TakesEveryRotationWrittenWithThreeDigits) {
  std::mt19937 engine(5);
  std::normal_distribution<double> draw;
  for (int i = 0; i < 1000; ++i) {
    const Pose exact(Eigen::Quaterniond(draw(engine), draw(engine), draw(engine), draw(engine)).normalized());
    Pose pose = exact;
    pose.linear() = (1e3 * pose.linear()).array().round() / 1e3;
    const Pose rigid = orthonormalised(pose);
    EXPECT_TRUE(is_rigid(rigid));
    EXPECT_LT((rigid.linear() - exact.linear()).norm(), 3e-3);
    pose = exact;
    pose.linear() *= 1.0009;
    EXPECT_TRUE(orthonormalised(pose).linear().isApprox(exact.linear(), 1e-9));
  }
}

TEST(Orthonormalised, RefusesWhatIsNoRigidTransform) {
  const auto refused = [](auto&& spoil) {
    Pose pose = pose_looking({1.0, 2.0, 3.0}, 0.7, 0.2);
    spoil(pose);
    EXPECT_THROW((void)orthonormalised(pose), std::invalid_argument);
  };
  refused([](Pose& pose) { pose.linear() *= 1.003; });
  refused([](Pose& pose) { pose.linear().col(0) *= -1.0; });
  refused([](Pose& pose) { pose.linear().setZero(); });
  refused([](Pose& pose) { pose.linear()(1, 1) = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Pose& pose) { pose.translation().y() = std::numeric_limits<double>::infinity(); });
}

}  // namespace
}  // namespace vantage
