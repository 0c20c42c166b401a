// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vantage/evaluation/view_cover.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr VoxelBox kBox{{-3, -2, 0}, {9, 7, 8}};

std::vector<CellSet> random_sets(std::mt19937& engine, std::size_t count, std::int32_t longest) {
  const auto within = [&](std::int32_t span) {
    return static_cast<std::int32_t>(engine() % static_cast<std::uint32_t>(span));
  };
  std::vector<CellSet> sets(count, CellSet(kBox));
  for (CellSet& set : sets) {
    const VoxelIndex lo{within(12) - 3, within(9) - 2, within(8)};
    const VoxelIndex size{1 + within(longest), 1 + within(longest), 1 + within(longest)};
    for_each_cell({lo, lo + size}, [&](const VoxelIndex& cell) { set.insert(cell); });
  }
  return sets;
}

CellSet union_of(const std::vector<CellSet>& sets, const std::vector<std::size_t>& which) {
  CellSet all(kBox);
  for (const std::size_t i : which) {
    all |= sets[i];
  }
  return all;
}

std::vector<std::size_t> numbers(std::size_t count) {
  std::vector<std::size_t> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i] = i;
  }
  return all;
}

// The minimum number of sets that cover the union of all, by exhaustive search.
std::size_t fewest(const std::vector<CellSet>& sets) {
  const CellSet all = union_of(sets, numbers(sets.size()));
  std::size_t best = sets.size();
  for (std::uint32_t selection = 0; selection < 1U << sets.size(); ++selection) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if ((selection >> i & 1U) != 0) {
        chosen.push_back(i);
      }
    }
    if (chosen.size() < best && union_of(sets, chosen) == all) {
      best = chosen.size();
    }
  }
  return best;
}

TEST(ViewCover, SeesAllThatAllSeeWithNoneToSpare) {
  std::mt19937 engine(91);
  std::size_t chosen_in_all = 0;
  for (int run = 0; run < 300; ++run) {
    const std::vector<CellSet> sets = random_sets(engine, 1 + engine() % 30, 6);
    const std::vector<std::size_t> cover = cover_views(sets);
    const CellSet all = union_of(sets, numbers(sets.size()));
    EXPECT_EQ(union_of(sets, cover), all);
    for (const std::size_t spared : cover) {
      std::vector<std::size_t> others = cover;
      std::erase(others, spared);
      EXPECT_FALSE(union_of(sets, others) == all);
    }
    chosen_in_all += cover.size();
  }
  EXPECT_GT(chosen_in_all, 1500U);
}

TEST(ViewCover, IsSeldomLargerThanTheSmallestThereIs) {
  std::mt19937 engine(92);
  std::size_t chosen = 0;
  std::size_t needed = 0;
  for (int run = 0; run < 60; ++run) {
    const std::vector<CellSet> sets = random_sets(engine, 10, 9);
    const std::size_t least = fewest(sets);
    const std::size_t found = cover_views(sets).size();
    EXPECT_GE(found, least);
    chosen += found;
    needed += least;
  }
  EXPECT_LE(static_cast<double>(chosen), 1.05 * static_cast<double>(needed));
}

TEST(ViewCover, TakesNoViewThatSeesNothing) {
  EXPECT_TRUE(cover_views({}).empty());
  EXPECT_TRUE(cover_views(std::vector<CellSet>(3, CellSet(kBox))).empty());
}

}  // namespace
}  // namespace vantage
