// SPDX-License-Identifier: MIT
#include <vantage/map/brick.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace vantage {
namespace {

TEST(Brick, HoldsEachCellOfItsBoxOnce) {
  for (const VoxelIndex& brick : {VoxelIndex{0, 0, 0}, VoxelIndex{-3, 2, -1}, VoxelIndex{1 << 20, -(1 << 20), 7}}) {
    std::vector<bool> held(Brick::kCells);
    for_each_cell(Brick::cells_of(brick), [&](const VoxelIndex& cell) {
      const std::size_t offset = Brick::offset_of(cell);
      EXPECT_EQ(Brick::of_cell(cell), brick);
      EXPECT_EQ(Brick::cell_at(brick, offset), cell);
      EXPECT_FALSE(held[offset]);
      held[offset] = true;
    });
    EXPECT_EQ(std::vector<bool>(Brick::kCells, true), held);
  }
}

TEST(Brick, CellsOfABoxOfBricksAreOverThatBox) {
  const VoxelBox bricks{{-2, 0, 3}, {1, 1, 5}};
  EXPECT_EQ(Brick::cells_of(bricks), (VoxelBox{{-16, 0, 24}, {8, 8, 40}}));
  EXPECT_EQ(Brick::over(Brick::cells_of(bricks)), bricks);
}

TEST(Brick, OffsetsOfAPlaneAreItsBitsInAscendingOrder) {
  std::mt19937_64 rng(1);
  for (int trial = 0; trial < 100; ++trial) {
    BrickPlane plane{};
    for (std::uint64_t& word : plane) {
      word = rng() & rng();
    }
    std::vector<std::size_t> expected;
    for (std::size_t offset = 0; offset < Brick::kCells; ++offset) {
      if ((plane[offset / 64] >> (offset % 64) & 1U) != 0) {
        expected.push_back(offset);
      }
    }
    std::vector<std::size_t> visited;
    for_each_offset(plane, [&](std::size_t offset) { visited.push_back(offset); });
    EXPECT_EQ(visited, expected);
  }
}

}  // namespace
}  // namespace vantage
