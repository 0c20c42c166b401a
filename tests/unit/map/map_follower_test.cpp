// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vantage/map/map_follower.hpp>

#include "support/changing_map.hpp"
#include "support/grid_host.hpp"

namespace vantage {
namespace {

using test::GridHost;

// Faces of the grid do not coincide with those of bricks.
constexpr VoxelBox kGrid{{-21, -13, -5}, {22, 17, 12}};

// Compares with a map in which the cells are set one by one. The host is never asked for a cell that it does not
// hold, although its border cuts through bricks.
TEST(MapFollower, HoldsTheStatesOfAHost) {
  std::mt19937 engine(31);
  std::size_t compared = 0;
  std::size_t changes = 0;
  for (int world = 0; world < 40; ++world) {
    OccupancyMapOptions options;
    if (world % 3 == 1) {
      options.region = Box{{-1.05, -0.65, -0.3}, {1.2, 1.45, 0.95}};
    }
    GridHost host(kGrid);
    MapFollower follower(options);
    OccupancyMap expected(options);
    for (int step = 0; step < 20; ++step) {
      VoxelBox changed = test::change(host, engine);
      BrickSet cells;
      for_each_cell(changed, [&](const VoxelIndex& cell) { cells.insert(cell); });
      std::size_t differing = 0;
      for_each_cell(changed, [&](const VoxelIndex& cell) {
        differing += expected.in_region(cell) && expected.at(cell) != host.at(cell) ? 1U : 0U;
        expected.set(cell, host.at(cell));
      });
      const OccupancyMap::Revision before = follower.map().revision();
      ASSERT_EQ(step % 2 == 0 ? follower.update(host, changed) : follower.update(host, cells), differing);
      ASSERT_EQ(follower.map().revision(), before + 1);
      ASSERT_EQ(follower.map().changed_since(before).empty(), differing == 0);
      changes += differing;
    }
    for_each_cell(kGrid.grown(9), [&](const VoxelIndex& cell) {
      ASSERT_EQ(follower.map().at(cell), expected.at(cell));
      ASSERT_EQ(follower.map().log_odds(cell), expected.log_odds(cell));
      ++compared;
    });
    ASSERT_EQ(follower.map().bounds(), expected.bounds());
    // Nothing has changed: the revision of a scan that teaches nothing, no brick is written.
    const OccupancyMap::Revision before = follower.map().revision();
    ASSERT_EQ(follower.update(host, kGrid), 0U);
    ASSERT_EQ(follower.map().revision(), before + 1);
    follower.map().for_each_written_since(before,
                                          [](const VoxelIndex&, const Brick&) { FAIL() << "nothing to write"; });
  }
  EXPECT_GT(compared, 2'000'000U);
  EXPECT_GT(changes, 100'000U);
}

// A map of vantage answers log-odds: its mirror is equal to the last bit, contested cells included.
TEST(MapFollower, HoldsTheLogOddsOfAHostThatHasThem) {
  std::mt19937 engine(32);
  std::size_t contested = 0;
  OccupancyMap host;
  MapFollower follower(host.options());
  for (int step = 0; step < 60; ++step) {
    const OccupancyMap::Revision before = host.revision();
    change_around_origin(host, engine);
    BrickSet written;
    host.for_each_written_since(
        before, [&](const VoxelIndex& brick, const Brick&) { written.plane(brick).fill(~std::uint64_t{0}); });
    follower.update(host, written);
    host.for_each_known([&](const VoxelIndex& cell, Occupancy) {
      ASSERT_EQ(follower.map().log_odds(cell), host.log_odds(cell));
      contested += follower.map().contested(cell) ? 1U : 0U;
    });
    ASSERT_EQ(follower.map().counts().free, host.counts().free);
    ASSERT_EQ(follower.map().counts().occupied, host.counts().occupied);
  }
  EXPECT_GT(contested, 50U);
}

TEST(MapFollower, KeepsToTheMemoryLimit) {
  std::mt19937 engine(33);
  GridHost host(kGrid);
  MapFollower follower({.max_bytes = 60'000});
  std::size_t known = 0;
  for (int step = 0; step < 100; ++step) {
    follower.update(host, test::change(host, engine));
    ASSERT_LE(follower.map().memory_bytes(), 60'000U);
    follower.map().for_each_known([&](const VoxelIndex& cell, Occupancy state) {
      ASSERT_EQ(state, host.at(cell));
      ++known;
    });
  }
  EXPECT_GT(known, 1000U);
  EXPECT_GT(follower.map().cells_refused(), 1000U);
}

struct NotANumber {
  [[nodiscard]] static std::optional<double> log_odds(const VoxelIndex& /*cell*/) {
    return std::numeric_limits<double>::quiet_NaN();
  }
};

TEST(MapFollower, RefusesWhatHasNoMeaning) {
  const GridHost host(kGrid);
  MapFollower follower(OccupancyMapOptions{});
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max() - 8;
  EXPECT_THROW(follower.update(host, VoxelBox{{0, 0, 0}, {kFar, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(follower.update(host, VoxelBox{{0, 0, 0}, {2048, 2048, 2048}}), std::invalid_argument);
  BrickSet far;
  far.insert({kFar, 0, 0});
  EXPECT_THROW(follower.update(host, far), std::invalid_argument);
  EXPECT_EQ(follower.map().revision(), 0U);
  EXPECT_THROW(follower.update(NotANumber{}, VoxelBox{{0, 0, 0}, {1, 1, 1}}), std::invalid_argument);
  EXPECT_EQ(follower.update(host, VoxelBox{}), 0U);
}

}  // namespace
}  // namespace vantage
