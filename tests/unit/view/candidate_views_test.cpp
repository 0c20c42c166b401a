// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace vantage
