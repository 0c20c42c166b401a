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

// More bricks than the platform is asked about at once.
TEST(AdmittedCells, OfALargeMapAreThoseThatThePlatformAdmits) {
  OccupancyMap map({.resolution_m = 0.1});
  BrickPlane all;
  all.fill(~std::uint64_t{0});
  const VoxelBox bricks{{-30, -30, -5}, {30, 31, 14}};
  ASSERT_GT(bricks.size(), 65536U);
  for_each_cell(bricks, [&](const VoxelIndex& brick) { map.assign(brick, all, BrickPlane{}); });
  const VoxelBox cells = Brick::cells_of(bricks);
  std::mt19937 engine(5);
  for (int speck = 0; speck < 2000; ++speck) {
    const auto within = [&](std::int32_t lo, std::int32_t hi) {
      return lo + static_cast<std::int32_t>(engine() % static_cast<std::uint32_t>(hi - lo));
    };
    map.set({within(cells.lo.x, cells.hi.x), within(cells.lo.y, cells.hi.y), within(cells.lo.z, cells.hi.z)},
            Occupancy::Occupied);
  }
  const FreeFlyer flyer({.radius_m = 0.25});
  AdmittedCells admitted;
  admitted.follow(map, flyer);
  const VoxelGrid<std::uint8_t> expected = flyer.admitted_cells(map, cells);
  std::size_t wrong = 0;
  std::size_t refused = 0;
  for_each_cell(cells, [&](const VoxelIndex& cell) {
    wrong += admitted.contains(cell) != (expected[cell] != 0) ? 1U : 0U;
    refused += expected[cell] == 0 ? 1U : 0U;
  });
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(refused, 100000U);
}

}  // namespace
}  // namespace vantage
