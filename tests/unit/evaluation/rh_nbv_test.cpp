// SPDX-License-Identifier: MIT
#include "evaluation/rh_nbv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vantage {
namespace {

using detail::TreeNode;

// All branches from `node` on, walked from the root to their ends.
void walk_all(const std::vector<TreeNode>& tree, std::size_t node, double value, std::vector<double>& values) {
  values[node] = value;
  for (std::size_t next = 1; next < tree.size(); ++next) {
    if (tree[next].parent == node) {
      walk_all(tree, next, value + tree[next].gain / std::exp(0.5 * tree[next].way_m), values);
    }
  }
}

TEST(RhNbv, ABranchIsWorthWhatAllOfItsNodesShowDiscountedByTheWay) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> draw(0.0, 3.0);
  std::size_t nodes = 0;
  for (std::size_t size = 1; size <= 60; ++size) {
    std::vector<TreeNode> tree(size);
    for (std::size_t i = 1; i < size; ++i) {
      tree[i].parent = engine() % i;
      tree[i].way_m = tree[tree[i].parent].way_m + draw(engine);
      tree[i].gain = draw(engine);
    }
    std::vector<double> expected(size);
    walk_all(tree, 0, 0.0, expected);
    const std::vector<double> values = detail::branch_values(tree, 0.5);
    ASSERT_EQ(values.size(), size);
    for (std::size_t i = 0; i < size; ++i, ++nodes) {
      EXPECT_NEAR(values[i], expected[i], 1e-9);
    }
  }
  EXPECT_EQ(nodes, 1830U);
}

}  // namespace
}  // namespace vantage
