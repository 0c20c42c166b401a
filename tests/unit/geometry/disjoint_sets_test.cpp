// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vantage/geometry/disjoint_sets.hpp>

namespace vantage {
namespace {

// Against labels that are rewritten at every merge.
TEST(DisjointSets, EqualLabelsThatAreRewritten) {
  std::mt19937 engine(61);
  std::size_t merges = 0;
  std::size_t in_vain = 0;
  for (int world = 0; world < 200; ++world) {
    const std::size_t size = 1 + engine() % 40;
    DisjointSets sets(size);
    std::vector<std::size_t> label(size);
    for (std::size_t i = 0; i < size; ++i) {
      label[i] = i;
    }
    for (std::size_t merge = 0; merge < size; ++merge) {
      const std::size_t a = engine() % size;
      const std::size_t b = engine() % size;
      const std::size_t lower = std::min(label[a], label[b]);
      const std::size_t upper = std::max(label[a], label[b]);
      ASSERT_EQ(sets.same(a, b), lower == upper);
      ASSERT_EQ(sets.merge(a, b), lower != upper);
      std::replace(label.begin(), label.end(), upper, lower);
      (lower == upper ? in_vain : merges) += 1;
    }
    const std::set<std::size_t> kept(label.begin(), label.end());  // a label is the first element of its set
    ASSERT_EQ(sets.count(), kept.size());
    const std::vector<std::size_t> labels = sets.labels();
    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_EQ(labels[i], static_cast<std::size_t>(std::distance(kept.begin(), kept.find(label[i]))));
    }
  }
  EXPECT_GE(merges, 1500U);
  EXPECT_GE(in_vain, 300U);
}

}  // namespace
}  // namespace vantage
