// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vantage/view/candidate_views.hpp>

namespace vantage {
namespace {

TEST(CandidateViews, AnIcosahedronLooksEverywhereAlike) {
  std::size_t faces = 20;
  for (int subdivisions = 0; subdivisions <= 4; ++subdivisions, faces *= 4) {
    const std::vector<Eigen::Vector3d> directions = icosahedron_directions(subdivisions);
    ASSERT_EQ(directions.size(), faces);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const double mean_gap = std::sqrt(4.0 * std::acos(-1.0) / static_cast<double>(faces));
    for (const Eigen::Vector3d& direction : directions) {
      EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
      sum += direction;
      double nearest = 4.0;
      for (const Eigen::Vector3d& other : directions) {
        nearest = &other == &direction ? nearest : std::min(nearest, (direction - other).norm());
      }
      EXPECT_GT(nearest, 0.5 * mean_gap);
      EXPECT_LT(nearest, 1.1 * mean_gap);
    }
    EXPECT_NEAR(sum.norm(), 0.0, 1e-9);
  }
  EXPECT_THROW((void)icosahedron_directions(-1), std::invalid_argument);
  EXPECT_THROW((void)icosahedron_directions(9), std::invalid_argument);
}

TEST(CandidateViews, ShellsLookAtTheirMiddle) {
  const Eigen::Vector3d target(0.3, -0.2, 0.9);
  const std::array<double, 2> radii{0.5, 1.5};
  const std::vector<Pose> views = views_around(target, radii, 2);
  ASSERT_EQ(views.size(), 640U);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Eigen::Vector3d line = target - views[i].translation();
    EXPECT_NEAR(line.norm(), i < 320 ? 0.5 : 1.5, 1e-12);
    EXPECT_NEAR(optical_axis(views[i]).dot(line.normalized()), 1.0, 1e-12);
    EXPECT_TRUE(is_rigid(views[i]));
  }
  const std::array<double, 1> none{0.0};
  EXPECT_THROW((void)views_around(target, none), std::invalid_argument);
}

TEST(CandidateViews, RandomViewsFillTheWorkspaceAndRepeat) {
  const Box workspace{{-1, 2, 0}, {3, 4, 1}};
  const std::vector<Pose> views = random_views(workspace, 1500, 7);
  ASSERT_EQ(views.size(), 1500U);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();
  const std::vector<Pose> again = random_views(workspace, 1500, 7);
  const std::vector<Pose> aimed = random_views_of({0, 0, 0}, workspace, 1500, 7);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_TRUE(workspace.contains(views[i].translation()));
    EXPECT_EQ(views[i].matrix(), again[i].matrix());
    EXPECT_EQ(views[i].translation(), aimed[i].translation());
    EXPECT_NEAR(optical_axis(aimed[i]).dot(-aimed[i].translation().normalized()), 1.0, 1e-12);
    mean += views[i].translation() / 1500.0;
    axes += optical_axis(views[i]) / 1500.0;
  }
  EXPECT_LT((mean - workspace.centre()).norm(), 0.1);
  EXPECT_LT(axes.norm(), 0.06);
  EXPECT_NE(random_views(workspace, 1, 8)[0].matrix(), views[0].matrix());
  EXPECT_THROW((void)random_views({}, 3, 7), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
