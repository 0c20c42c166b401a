// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vantage/raytrace/cell_set.hpp>

namespace vantage {
namespace {

TEST(CellSet, AWordAtATimeIsItsCellsOneByOne) {
  std::mt19937_64 engine(5);
  const auto drawn = [&](std::int32_t lo, std::int32_t hi) {
    return std::uniform_int_distribution<std::int32_t>(lo, hi)(engine);
  };
  int empty_boxes = 0;
  for (int round = 0; round < 400; ++round) {
    const VoxelIndex lo{drawn(-9, 9), drawn(-9, 9), drawn(-9, 9)};
    const VoxelBox box{lo, lo + VoxelIndex{drawn(0, 11), drawn(0, 11), drawn(0, 11)}};
    empty_boxes += box.empty() ? 1 : 0;
    CellSet by_word(box);
    CellSet by_cell(box);
    for (int i = 0; i < 8; ++i) {
      const VoxelIndex word{drawn(-4, 6), drawn(-4, 6), drawn(-4, 6)};
      const std::uint64_t cells = engine();
      by_word.insert_word(word, cells);
      for (std::int32_t k = 0; k < 64; ++k) {
        if ((cells >> k & 1U) != 0) {
          by_cell.insert({word.x * 4 + k % 4, word.y * 4 + k / 4 % 4, word.z * 4 + k / 16});
        }
      }
    }
    EXPECT_EQ(by_word.size(), by_cell.size());
    for_each_cell(box, [&](const VoxelIndex& cell) { EXPECT_EQ(by_word.contains(cell), by_cell.contains(cell)); });
  }
  EXPECT_GT(empty_boxes, 40);
}

}  // namespace
}  // namespace vantage
