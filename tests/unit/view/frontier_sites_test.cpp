// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vantage/geometry/raster_order.hpp>
#include <vector>

#include <vantage/view/impl/frontier_sites.hpp>

namespace vantage {
namespace {

using detail::FrontierSite;

TEST(FrontierSites, HoldEveryTargetOnceAndAreNoLargerThanAllowed) {
  std::mt19937 engine(7);
  std::size_t sites_seen = 0;
  for (int seed = 0; seed < 20; ++seed) {
    std::set<VoxelIndex> cells;
    VoxelIndex walk{0, 0, 0};
    for (int i = 0; i < 300; ++i) {
      walk = walk + kAllNeighbours[engine() % 26];
      cells.insert(walk);
      walk = engine() % 60 == 0 ? walk + VoxelIndex{9, -4, 0} : walk;
    }
    std::vector<VoxelIndex> sorted(cells.begin(), cells.end());
    std::sort(sorted.begin(), sorted.end(), RasterOrder{});
    std::vector<FrontierTarget> targets;
    for (const VoxelIndex& cell : sorted) {
      targets.push_back({cell, cell + VoxelIndex{1, 0, 0}, cell});
    }
    const VoxelIndex most{3 + seed % 6, 3 + seed % 6, 2 + seed % 11};
    std::set<VoxelIndex> held;
    for (const FrontierSite& site : detail::frontier_sites(targets, most)) {
      ++sites_seen;
      bool holds_middle = false;
      for (const FrontierTarget& a : site.targets) {
        EXPECT_TRUE(held.insert(a.frontier).second);
        holds_middle = holds_middle || a.frontier == site.middle.frontier;
        for (const FrontierTarget& b : site.targets) {
          const VoxelIndex apart = a.frontier - b.frontier;
          EXPECT_LT(apart.x, most.x);
          EXPECT_LT(apart.y, most.y);
          EXPECT_LT(apart.z, most.z);
        }
      }
      EXPECT_TRUE(holds_middle);
    }
    EXPECT_EQ(held, cells);
  }
  EXPECT_GT(sites_seen, 100U);
}

TEST(FrontierSites, APartThatIsSmallEnoughIsNotDividedAndItsMiddleIsInTheMiddle) {
  std::vector<FrontierTarget> targets;
  for (std::int32_t x = 0; x < 7; ++x) {
    targets.push_back({{x, 0, 0}, {x, 1, 0}, {x, -1, 0}});
  }
  const std::vector<FrontierSite> whole = detail::frontier_sites(targets, {7, 1, 1});
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole.front().middle.frontier, (VoxelIndex{3, 0, 0}));
  EXPECT_EQ(detail::frontier_sites(targets, {6, 9, 9}).size(), 2U);
  EXPECT_TRUE(detail::frontier_sites({}, {6, 6, 6}).empty());
}

}  // namespace
}  // namespace vantage
