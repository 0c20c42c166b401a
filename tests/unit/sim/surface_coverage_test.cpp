// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <sim/surface_coverage.hpp>

namespace vantage {
namespace {

TEST(SurfaceCoverage, CountsWhatTryingAllPairsCounts) {
  std::mt19937 engine(61);
  std::uniform_real_distribution<double> metre(-0.1, 0.1);
  std::size_t cases = 0;
  std::size_t measured_in_all = 0;
  for (int world = 0; world < 20; ++world) {
    const double gap_m = 0.003 + 0.001 * world;
    std::vector<Eigen::Vector3d> samples(500);
    for (Eigen::Vector3d& sample : samples) {
      sample = {metre(engine), metre(engine), metre(engine)};
    }
    SurfaceCoverage coverage(samples, gap_m);
    EXPECT_EQ(coverage.share(), 0.0);
    std::vector<bool> measured(samples.size(), false);
    for (int view = 0; view < 4; ++view) {
      Scan scan;
      scan.world_from_sensor = pose_looking({metre(engine), metre(engine), metre(engine)}, 10.0 * metre(engine));
      for (int i = 0; i < 200; ++i) {
        scan.points.push_back(
            (scan.world_from_sensor.inverse() * Eigen::Vector3d(metre(engine), metre(engine), metre(engine)))
                .cast<float>());
      }
      scan.points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
      coverage.add(scan);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        for (const Eigen::Vector3f& point : scan.points) {
          const double distance_m = (scan.world_from_sensor * point.cast<double>() - samples[i]).norm();
          measured[i] = measured[i] || distance_m <= gap_m;
        }
      }
      const auto count = static_cast<std::size_t>(std::count(measured.begin(), measured.end(), true));
      EXPECT_EQ(coverage.share(), static_cast<double>(count) / 500.0);
      measured_in_all += count;
      ++cases;
    }
  }
  EXPECT_EQ(cases, 80U);
  EXPECT_GT(measured_in_all, 1'000U);
  EXPECT_EQ(SurfaceCoverage({}, 0.01).share(), 1.0);
}

}  // namespace
}  // namespace vantage
