// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vantage/robot/admitted_cells.hpp>
#include <vantage/robot/free_flyer.hpp>

#include "support/changing_map.hpp"
#include "support/sanitized.hpp"

namespace vantage {
namespace {

// Compares with a new object and with single queries after every few of thousands of changes.
TEST(AdmittedCells, FollowWhateverHappensToAMap) {
  std::mt19937 engine(17);
  std::size_t compared = 0;
  constexpr int kWorlds = test::kSanitized ? 2 : 6;
  for (int world = 0; world < kWorlds; ++world) {
    OccupancyMap map({.resolution_m = 0.1});
    const FreeFlyer flyer({.radius_m = 0.07 * (world % 4), .min_height_m = -0.5});
    AdmittedCells followed;
    for (int step = 0; step < 400; ++step) {
      change_around_origin(map, engine);
      if (step == 250) {
        map = OccupancyMap(map);  // another map with a new change log
      }
      if (engine() % 3 != 0) {
        continue;
      }
      followed.follow(map, flyer);
      AdmittedCells fresh;
      fresh.follow(map, flyer);
      map.for_each_brick([&](const VoxelIndex& address, const Brick& /*brick*/) {
        const BrickPlane* ours = followed.cells().find(address);
        const BrickPlane* theirs = fresh.cells().find(address);
        ASSERT_EQ(ours == nullptr ? BrickPlane{} : *ours, theirs == nullptr ? BrickPlane{} : *theirs);
        ++compared;
      });
      ASSERT_EQ(followed.cells().size(), fresh.cells().size());
    }
  }
  EXPECT_GT(compared, 3000U * kWorlds);
}

}  // namespace
}  // namespace vantage
