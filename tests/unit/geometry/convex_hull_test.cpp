// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vantage/geometry/convex_hull.hpp>

namespace vantage {
namespace {

// Independent definition of a hull: a tetrahedron contains a point if its barycentric weights are >= 0, and the hull
// of a small cloud contains a point exactly if one of its tetrahedra does (Caratheodory).
bool in_some_tetrahedron(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& point) {
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      for (std::size_t c = b + 1; c < points.size(); ++c) {
        for (std::size_t d = c + 1; d < points.size(); ++d) {
          Eigen::Matrix3d edges;
          edges << points[b] - points[a], points[c] - points[a], points[d] - points[a];
          if (std::abs(edges.determinant()) < 1e-12) {
            continue;
          }
          const Eigen::Vector3d weights = edges.inverse() * (point - points[a]);
          if (weights.minCoeff() >= 0.0 && weights.sum() <= 1.0) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

TEST(ConvexHull, HoldsWhatSomeTetrahedronOfItsPointsHolds) {
  std::mt19937 engine(21);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto random_point = [&] {
    return Eigen::Vector3d(coordinate(engine), coordinate(engine), coordinate(engine));
  };
  std::size_t inside = 0;
  std::size_t compared = 0;
  for (int cloud = 0; cloud < 60; ++cloud) {
    const Eigen::Vector3d far = cloud % 3 == 0 ? Eigen::Vector3d(1000.0, -2000.0, 500.0) : Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 4 + cloud % 9; ++i) {
      points.push_back(random_point() + far);
    }
    const ConvexHull hull(points);
    ASSERT_FALSE(hull.empty()) << hull.reason();
    for (const Eigen::Vector3d& point : points) {
      EXPECT_TRUE(hull.contains(point));
    }
    for (const ConvexHull::Plane& plane : hull.planes()) {
      EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    }
    for (int probe = 0; probe < 60; ++probe) {
      const Eigen::Vector3d point = random_point() + far;
      const bool expected = in_some_tetrahedron(points, point);
      EXPECT_EQ(hull.contains(point), expected);
      inside += expected ? 1U : 0U;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3600U);
  EXPECT_GT(inside, 300U);
}

TEST(ConvexHull, AGridOfPointsIsABox) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 5 * 6 * 7; ++i) {
    points.emplace_back(i % 5, i / 5 % 6, i / 30);
  }
  const ConvexHull hull(points);
  EXPECT_EQ(hull.planes().size(), 6U);
  EXPECT_EQ(ConvexHull(hull.corners()).planes().size(), 6U);
  EXPECT_TRUE(hull.contains({4.0, 5.0, 6.0}));
  EXPECT_FALSE(hull.contains({4.0, 5.0, 6.001}));
  EXPECT_TRUE(hull.contains({4.0, 5.0, 6.001}, 0.01));
}

TEST(ConvexHull, WithoutVolumeItIsEmptyAndSaysWhy) {
  EXPECT_EQ(ConvexHull().reason(), "there are no points");
  EXPECT_FALSE(ConvexHull().contains({0, 0, 0}));
  EXPECT_EQ(ConvexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).reason(), "there are fewer than four points");
  EXPECT_EQ(ConvexHull(std::vector<Eigen::Vector3d>(5, {1, 2, 3})).reason(), "all points are one");
  EXPECT_EQ(ConvexHull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {-3, -3, -3}}).reason(), "all points lie on one line");
  const ConvexHull flat({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {5, 2, 1}});
  EXPECT_EQ(flat.reason(), "all points lie in one plane");
  EXPECT_FALSE(flat.contains({0.5, 0.5, 1}));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ConvexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, kNan, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
