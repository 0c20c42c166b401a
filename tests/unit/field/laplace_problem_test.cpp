// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vantage/field/laplace_domain.hpp>
#include <vantage/field/laplace_problem.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

TEST(LaplaceProblem, NeighboursAreTheCellsBesideAndTheRestIsClosed) {
  std::mt19937 engine(1);
  std::size_t faces = 0;
  for (int world = 0; world < 100; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    for (Position i = 0; i < static_cast<Position>(problem.size()); ++i) {
      for (std::size_t face = 0; face < 6; ++face, ++faces) {
        const auto expected = problem.position_of(problem.cell(i) + kFaceNeighbours[face]);
        ASSERT_EQ(problem.neighbours(i)[face], expected.value_or(LaplaceProblem::kClosed));
      }
    }
  }
  EXPECT_GE(faces, 10000U);
}

TEST(LaplaceProblem, KeepsOnlyTheComponentOfTheSourceAndCountsTheRest) {
  const std::vector<VoxelIndex> cells{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {4, 0, 0}, {5, 0, 0}, {1, 1, 1}};
  const std::vector<VoxelIndex> sinks{{2, 0, 0}, {5, 0, 0}};
  const LaplaceProblem problem(cells, sinks, {0, 0, 0});
  EXPECT_EQ(problem.size(), 3U);
  EXPECT_EQ(problem.dropped_cells(), 3U);
  EXPECT_EQ(problem.sink_count(), 1U);
  EXPECT_EQ(problem.kind(problem.source()), LaplaceCell::Source);
  EXPECT_FALSE(problem.position_of({4, 0, 0}));
}

TEST(LaplaceProblem, RefusesWhatDoesNotFit) {
  const std::vector<VoxelIndex> cells{{0, 0, 0}, {1, 0, 0}};
  const std::vector<VoxelIndex> twice{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const std::vector<VoxelIndex> elsewhere{{7, 0, 0}};
  const std::vector<VoxelIndex> at_source{{0, 0, 0}};
  EXPECT_THROW(LaplaceProblem(twice, {}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(LaplaceProblem(cells, {}, {2, 0, 0}), std::invalid_argument);
  EXPECT_THROW(LaplaceProblem(cells, elsewhere, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(LaplaceProblem(cells, at_source, {0, 0, 0}), std::invalid_argument);
  EXPECT_NO_THROW(LaplaceProblem(cells, {}, {0, 0, 0}));
  LaplaceDomain domain;
  domain.insert({0, 0, 0});
  domain.insert_sink({1, 0, 0});
  EXPECT_THROW(LaplaceProblem(domain, {1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(LaplaceProblem(domain, {2, 0, 0}), std::invalid_argument);
  EXPECT_EQ(LaplaceProblem(domain, {0, 0, 0}).sink_count(), 1U);
}

}  // namespace
}  // namespace vantage
