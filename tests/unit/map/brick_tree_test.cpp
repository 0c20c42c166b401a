// SPDX-License-Identifier: MIT
#include <vantage/map/impl/brick_tree.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace vantage {
namespace {

// Compares with a test of every brick, for boxes of all sizes and bricks near and far apart.
TEST(BrickTree, TellsWhetherABoxTouchesABrick) {
  std::mt19937 engine(3);
  std::size_t touched = 0;
  std::size_t missed = 0;
  for (const std::int32_t spread : {3, 40, 5000, 100'000'000}) {
    for (int set = 0; set < 20; ++set) {
      std::uniform_int_distribution<std::int32_t> brick(-spread, spread);
      detail::BrickTree tree;
      std::vector<VoxelIndex> bricks;
      for (int i = 0; i < 12 * (set % 4); ++i) {
        bricks.push_back({brick(engine), brick(engine), brick(engine) / 4});
        tree.insert(bricks.back());
      }
      for (int i = 0; i < 200; ++i) {
        const VoxelIndex lo{8 * brick(engine), 8 * brick(engine), 8 * (brick(engine) / 4)};
        const std::int32_t longest = i % 2 == 0 ? 30 : std::min(4 * spread, 100'000'000);
        std::uniform_int_distribution<std::int32_t> edge(0, longest);
        const VoxelBox box{lo, lo + VoxelIndex{edge(engine), edge(engine), edge(engine)}};
        const bool expected = !box.empty() && std::any_of(bricks.begin(), bricks.end(), [&](const VoxelIndex& one) {
          const VoxelIndex first = Brick::first_cell(one);
          return first.x < box.hi.x && first.x + 8 > box.lo.x && first.y < box.hi.y && first.y + 8 > box.lo.y &&
                 first.z < box.hi.z && first.z + 8 > box.lo.z;
        });
        ASSERT_EQ(tree.touches(box), expected);
        ++(expected ? touched : missed);
      }
    }
  }
  EXPECT_GT(touched, 1000U);
  EXPECT_GT(missed, 1000U);
}

}  // namespace
}  // namespace vantage
