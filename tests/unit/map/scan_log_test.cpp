// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vantage/map/scan_log.hpp>
#include <vector>

#include "support/random_maps.hpp"

namespace vantage {
namespace {

// Returns the number of compared cells.
std::size_t expect_equal(const OccupancyMap& a, const OccupancyMap& b) {
  std::size_t cells = 0;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    one->for_each_known([&, other = other, one = one](const VoxelIndex& cell, Occupancy state) {
      EXPECT_EQ(other->at(cell), state);
      EXPECT_EQ(other->log_odds(cell), one->log_odds(cell));
      ++cells;
    });
  }
  return cells;
}

// Loop closure: poses have drifted and are corrected later.
TEST(ScanLog, CorrectedPosesMakeTheMapOfTheRightOnes) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> drift(-0.3, 0.3);
  std::size_t compared = 0;
  std::size_t different = 0;
  for (int run = 0; run < 10; ++run) {
    ScanLog drifted({.resolution_m = 0.1});
    ScanLog right({.resolution_m = 0.1});
    std::vector<Pose> poses;
    for (int i = 0; i < 8; ++i) {
      Scan scan = test::random_scan(engine, 80);
      poses.push_back(scan.world_from_sensor);
      right.insert(scan);
      if (i >= 3) {  // the first poses are correct
        scan.world_from_sensor =
            Eigen::Translation3d(drift(engine), drift(engine), drift(engine)) * scan.world_from_sensor;
      }
      drifted.insert(std::move(scan));
    }
    different += drifted.map().counts().free != right.map().counts().free ? 1U : 0U;
    EXPECT_EQ(drifted.correct(poses), 5U);
    compared += expect_equal(drifted.map(), right.map());
    const OccupancyMap* before = &drifted.map();
    EXPECT_EQ(drifted.correct(poses), 0U) << "nothing is new";
    EXPECT_EQ(&drifted.map(), before);
  }
  EXPECT_GT(compared, 20000U);
  EXPECT_GT(different, 5U) << "the drift must matter";
}

TEST(ScanLog, ABadCorrectionChangesNothing) {
  std::mt19937 engine(9);
  ScanLog log({.resolution_m = 0.1});
  log.insert(test::random_scan(engine, 50));
  log.insert(test::random_scan(engine, 50));
  const OccupancyMap before = log.map();
  std::vector<Pose> poses(2, Pose::Identity());
  poses[1].linear() *= 2.0;
  EXPECT_THROW(log.correct(poses), std::invalid_argument);
  EXPECT_THROW(log.correct(std::vector<Pose>(3, Pose::Identity())), std::invalid_argument);
  EXPECT_GT(expect_equal(log.map(), before), 100U);
  Scan bad = test::random_scan(engine, 50);
  bad.max_range_m = -1.0;
  EXPECT_THROW(log.insert(bad), std::invalid_argument);
  EXPECT_EQ(log.scans().size(), 2U);
}

}  // namespace
}  // namespace vantage
