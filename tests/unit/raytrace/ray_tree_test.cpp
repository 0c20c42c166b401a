// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vantage/raytrace/ray_tree.hpp>

namespace vantage {
namespace {

TEST(RayTree, RaysAreThoseOfTheEquation) {
  const RangeSensor sensor = RangeSensor::pinhole(640, 480, 1.0, 0.75, 0.0, 4.0);
  const RayImage rays = equal_angle_rays(sensor, 0.01);
  const double step = std::asin(0.01 / 4.0);
  EXPECT_EQ(rays.width, static_cast<std::size_t>(std::ceil(1.0 / step)));
  EXPECT_EQ(rays.height, static_cast<std::size_t>(std::ceil(0.75 / step)));
  ASSERT_EQ(rays.directions.size(), rays.width * rays.height);
  const std::size_t row = 17;
  const std::size_t column = 111;
  const double beta = -0.375 + 17 * step;
  const double alpha = -0.5 + 111 * step;
  const Eigen::Vector3d expected(std::cos(beta) * std::sin(alpha), std::sin(beta), std::cos(beta) * std::cos(alpha));
  EXPECT_LT((rays.directions[row * rays.width + column].cast<double>() - expected).norm(), 1e-6);
  EXPECT_THROW((void)equal_angle_rays(sensor, 0.0), std::invalid_argument);
  EXPECT_THROW((void)equal_angle_rays(sensor, 4.0), std::invalid_argument);
}

// Cosine of the smallest angle to a ray of the level above, by trying all.
double nearest_cosine(const RayImage& above, const Eigen::Vector3f& ray) {
  double most = -2.0;
  for (const Eigen::Vector3f& other : above.directions) {
    most = std::max(most, ray.cast<double>().dot(other.cast<double>()));
  }
  return most;
}

TEST(RayTree, AParentIsTheNearestRayOfTheLevelAbove) {
  std::size_t rays = 0;
  for (const RangeSensor& sensor :
       {RangeSensor::pinhole(64, 48, 1.0, 0.75, 0.0, 4.0), RangeSensor::preset("vpl"),
        RangeSensor::spherical(64, 48, 6.2, 3.1, 0.0, 1.0), RangeSensor::pinhole(64, 48, 2.9, 0.3, 0.0, 2.0)}) {
    const RayTree tree(sensor, sensor.max_range_m / 50.0, 4);
    ASSERT_EQ(tree.levels(), 4);
    for (int level = 1; level < tree.levels(); ++level) {
      const RayImage& image = tree.rays(level);
      for (std::uint32_t ray = 0; ray < image.directions.size(); ray += 3) {
        const Eigen::Vector3f& parent = tree.rays(level - 1).directions[tree.parent(level, ray)];
        const Eigen::Vector3d direction = image.directions[ray].cast<double>();
        EXPECT_NEAR(direction.dot(parent.cast<double>()), nearest_cosine(tree.rays(level - 1), image.directions[ray]),
                    1e-6);
        ++rays;
      }
    }
  }
  EXPECT_GT(rays, 10'000U);
}

TEST(RayTree, EveryLeafCountsOnceAtEveryLevel) {
  const RayTree tree(RangeSensor::preset("kinect"), 0.02, 4);
  const std::size_t leaves = tree.rays(3).directions.size();
  for (int level = 0; level < tree.levels(); ++level) {
    std::size_t sum = 0;
    std::size_t children = 0;
    for (std::uint32_t ray = 0; ray < tree.rays(level).directions.size(); ++ray) {
      sum += tree.leaves(level, ray);
      for (const std::uint32_t child : tree.children(level, ray)) {
        EXPECT_EQ(tree.parent(level + 1, child), ray);
        ++children;
      }
    }
    EXPECT_EQ(sum, leaves);
    EXPECT_EQ(children, level == 3 ? 0 : tree.rays(level + 1).directions.size());
  }
  EXPECT_THROW(RayTree(RangeSensor::preset("kinect"), 0.02, 0), std::invalid_argument);
  EXPECT_THROW(RayTree(RangeSensor::preset("kinect"), 0.02, 9), std::invalid_argument);
}

}  // namespace
}  // namespace vantage
