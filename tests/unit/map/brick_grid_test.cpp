// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <unordered_map>
#include <vantage/map/brick_grid.hpp>

namespace vantage {
namespace {

TEST(BrickGrid, EqualsAMapWithADefault) {
  std::mt19937 engine(63);
  std::uniform_int_distribution<std::int32_t> at(-70, 70);
  const auto any = [&] { return VoxelIndex{at(engine), at(engine), at(engine)}; };
  BrickGrid<int> grid(-1);
  BrickGrid<int>::Writer write(grid);
  std::unordered_map<VoxelIndex, int> expected;
  std::set<BrickDirectory::Number> numbers;
  VoxelIndex last;
  for (int i = 0; i < 30000; ++i) {
    // Every other time beside the last cell, of which the writer holds the brick.
    last = i % 2 == 0 ? any() : last + VoxelIndex{1, 0, 0};
    const VoxelIndex cell = last;
    (i % 4 < 2 ? write(cell) : grid[cell]) = i;
    expected[cell] = i;
    const BrickDirectory::Number number = grid.number_of(Brick::of_cell(cell));
    ASSERT_LT(number, grid.bricks());
    ASSERT_EQ(grid.address(number), Brick::of_cell(cell));
    ASSERT_EQ(grid.values(number)[Brick::offset_of(cell)], i);
    numbers.insert(number);
  }
  EXPECT_EQ(numbers.size(), grid.bricks());
  EXPECT_GE(grid.bricks(), 4000U);
  BrickGrid<int>::Reader reader(grid);
  std::size_t unwritten = 0;
  for_each_cell({{-80, -80, -80}, {80, 80, 80}}, [&](const VoxelIndex& cell) {
    const auto found = expected.find(cell);
    const int value = found == expected.end() ? -1 : found->second;
    ASSERT_EQ(std::as_const(grid)[cell], value);
    ASSERT_EQ(reader(cell), value);
    unwritten += found == expected.end() ? 1U : 0U;
  });
  EXPECT_GE(unwritten, 1000000U);
  EXPECT_EQ(grid.number_of({100, 0, 0}), BrickDirectory::kNone);
}

}  // namespace
}  // namespace vantage
