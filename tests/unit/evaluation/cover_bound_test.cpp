// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vantage/evaluation/cover_bound.hpp>
#include <vantage/evaluation/view_cover.hpp>
#include <vector>

namespace vantage {
namespace {

constexpr VoxelBox kBoundBox{{-3, 0, 2}, {3, 5, 4}};

CellSet whole_box() {
  CellSet all(kBoundBox);
  for_each_cell(kBoundBox, [&](const VoxelIndex& cell) { all.insert(cell); });
  return all;
}

CellSet holding(std::initializer_list<int> columns) {
  CellSet set(kBoundBox);
  for (const int x : columns) {
    set.insert({x - 3, 1, 2});
  }
  return set;
}

/// The minimum number of sets that cover all coverable cells of `wanted`, by exhaustive search.
std::size_t fewest(const std::vector<CellSet>& sets, const CellSet& wanted) {
  const auto held_by = [&](std::uint32_t chosen) {
    std::size_t held = 0;
    wanted.for_each([&](const VoxelIndex& cell) {
      bool any = false;
      for (std::size_t i = 0; i < sets.size(); ++i) {
        any = any || ((chosen >> i & 1U) != 0 && sets[i].contains(cell));
      }
      held += any ? 1U : 0U;
    });
    return held;
  };
  const std::uint32_t all = (1U << sets.size()) - 1U;
  const std::size_t most = held_by(all);
  std::size_t least = sets.size();
  for (std::uint32_t chosen = 0; chosen <= all; ++chosen) {
    const auto count = static_cast<std::size_t>(std::popcount(chosen));
    if (count < least && held_by(chosen) == most) {
      least = count;
    }
  }
  return least;
}

TEST(CoverBound, NeverExceedsTheFewestAndIsRarelyFarFromThem) {
  std::mt19937_64 engine(1);
  std::size_t compared = 0;
  std::size_t tight = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<CellSet> sets(2 + engine() % 8, CellSet(kBoundBox));
    const std::uint64_t one_in = 2 + engine() % 5;
    CellSet wanted(kBoundBox);
    for_each_cell(kBoundBox, [&](const VoxelIndex& cell) {
      if (engine() % 4 != 0) {
        wanted.insert(cell);
      }
      for (CellSet& set : sets) {
        if (engine() % one_in == 0) {
          set.insert(cell);
        }
      }
    });
    const std::size_t exact = fewest(sets, wanted);
    for (const std::size_t most_cells : {std::size_t{5}, std::size_t{1000}}) {
      const double bound = fewest_views_bound(sets, wanted, 3000, most_cells);
      ASSERT_LE(bound, static_cast<double>(exact) + 1e-9);
      ASSERT_EQ(bound, fewest_views_bound(sets, wanted, 3000, most_cells));
      tight += most_cells > 5 && std::ceil(bound - 1e-9) == static_cast<double>(exact) ? 1U : 0U;
    }
    std::vector<CellSet> of_wanted = sets;
    CellSet unwanted = whole_box();
    unwanted -= wanted;
    for (CellSet& set : of_wanted) {
      set -= unwanted;
    }
    ASSERT_GE(cover_views(of_wanted).size(), exact);
    ++compared;
  }
  EXPECT_EQ(compared, 60U);
  EXPECT_GT(tight, 40U) << "rounded up, it is mostly the fewest";
}

TEST(CoverBound, KnowsWhatIsKnown) {
  const CellSet all = whole_box();
  const std::vector<CellSet> apart{holding({0}), holding({1, 2}), holding({3})};
  EXPECT_NEAR(fewest_views_bound(apart, all), 3.0, 0.02);
  EXPECT_LE(fewest_views_bound(apart, all), 3.0 + 1e-9);
  // Five cells in a ring, each in two views: two and a half.
  const std::vector<CellSet> ring{holding({0, 1}), holding({1, 2}), holding({2, 3}), holding({3, 4}),
                                  holding({4, 0})};
  EXPECT_NEAR(fewest_views_bound(ring, all), 2.5, 0.1);
  EXPECT_LE(fewest_views_bound(ring, all), 2.5 + 1e-9);
  EXPECT_EQ(fewest_views_bound(ring, CellSet(kBoundBox)), 0.0);
  EXPECT_EQ(fewest_views_bound({}, all), 0.0);
}

}  // namespace
}  // namespace vantage
