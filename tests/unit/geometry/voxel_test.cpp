// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vantage/geometry/voxel.hpp>

namespace vantage {
namespace {

// Any two corners, most of them far beyond what can be addressed; 128 bits hold every product.
TEST(VoxelBox, ExtentAndSizeOfAnyBoxFitTheirTypes) {
  __extension__ using Wide = unsigned __int128;
  std::mt19937 engine(3);
  std::size_t saturated = 0;
  std::size_t empty = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto coordinate = [&] { return static_cast<std::int32_t>(engine()) >> (i % 5 * 7); };
    const VoxelBox box{{coordinate(), coordinate(), coordinate()}, {coordinate(), coordinate(), coordinate()}};
    const VoxelIndex extent = box.extent();
    const auto expected = [&](std::int32_t lo, std::int32_t hi) {
      constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
      return box.empty() ? 0 : std::min(kMost, std::int64_t{hi} - lo);
    };
    ASSERT_EQ(extent.x, expected(box.lo.x, box.hi.x));
    ASSERT_EQ(extent.y, expected(box.lo.y, box.hi.y));
    ASSERT_EQ(extent.z, expected(box.lo.z, box.hi.z));
    const Wide cells =
        Wide(static_cast<unsigned>(extent.x)) * static_cast<unsigned>(extent.y) * static_cast<unsigned>(extent.z);
    constexpr Wide kMostCells = std::numeric_limits<std::size_t>::max();
    ASSERT_EQ(Wide(box.size()), std::min(cells, kMostCells));
    saturated += cells > kMostCells ? 1U : 0U;
    empty += box.empty() ? 1U : 0U;
  }
  EXPECT_GT(saturated, 100U);
  EXPECT_GT(empty, 5000U);
  EXPECT_LT(empty, 19000U);
}

}  // namespace
}  // namespace vantage
