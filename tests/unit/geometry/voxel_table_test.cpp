// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <unordered_map>
#include <vantage/geometry/voxel_table.hpp>

namespace vantage {
namespace {

// Keys near each other and far apart, negative ones included.
TEST(VoxelTable, EqualsAMap) {
  std::mt19937 engine(62);
  std::size_t known = 0;
  for (const std::int32_t reach : {3, 20, 1 << 28}) {
    std::uniform_int_distribution<std::int32_t> at(-reach, reach);
    VoxelTable<int> table;
    std::unordered_map<VoxelIndex, int> expected;
    EXPECT_EQ(table.find({0, 0, 0}), nullptr);
    for (int i = 0; i < 5000; ++i) {
      const VoxelIndex key{at(engine), at(engine), at(engine)};
      const bool is_new = expected.try_emplace(key, i).second;
      const std::size_t memory = is_new ? table.memory_with_another() : table.memory_bytes();
      ASSERT_EQ(table.place(key, i), expected.at(key));
      ASSERT_EQ(table.size(), expected.size());
      ASSERT_EQ(table.memory_bytes(), memory);
      const VoxelIndex asked{at(engine), at(engine), at(engine)};
      const auto found = expected.find(asked);
      const int* const value = table.find(asked);
      ASSERT_EQ(value != nullptr, found != expected.end());
      if (value != nullptr) {
        ASSERT_EQ(*value, found->second);
        ++known;
      }
    }
    for (const auto& [key, value] : expected) {
      ASSERT_EQ(*table.find(key), value);
    }
    table.clear();
    EXPECT_EQ(table.size(), 0U);
    EXPECT_EQ(table.find(expected.begin()->first), nullptr);
  }
  EXPECT_GE(known, 4000U);
}

}  // namespace
}  // namespace vantage
