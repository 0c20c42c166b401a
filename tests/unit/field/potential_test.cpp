// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vantage/field/potential.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

// Every cell of a box around the problem, bricks of negative addresses included.
TEST(Potential, HoldsAValueForTheCellsOfItsProblemAndForNoOther) {
  std::mt19937 engine(26);
  std::uniform_real_distribution<double> value(0.1, 1.0);
  std::size_t inside = 0;
  std::size_t outside = 0;
  for (int world = 0; world < 100; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine, 24).problem();
    std::vector<double> phi(problem.size());
    for (double& one : phi) {
      one = value(engine);
    }
    const Potential potential(problem, phi);
    EXPECT_EQ(potential.source(), problem.cell(problem.source()));
    EXPECT_EQ(potential.domain().sink_count(), problem.sink_count());
    for_each_cell({{-6, -6, -6}, {48, 48, 48}}, [&](const VoxelIndex& cell) {
      const auto position = problem.position_of(cell);
      ASSERT_EQ(potential.at(cell),
                position ? std::optional(phi[static_cast<std::size_t>(*position)]) : std::nullopt);
      ASSERT_EQ(potential.domain().is_sink(cell), position && problem.kind(*position) == LaplaceCell::Sink);
      (position ? inside : outside) += 1;
    });
  }
  EXPECT_GE(inside, 50000U);
  EXPECT_GE(outside, 1000000U);
}

TEST(Potential, WithoutValuesItIsOne) {
  LaplaceDomain domain;
  domain.insert({-1, 2, 3});
  const Potential potential(domain, {-1, 2, 3});
  EXPECT_EQ(potential.at({-1, 2, 3}), 1.0);
  EXPECT_EQ(potential.at({0, 2, 3}), std::nullopt);
}

TEST(Potential, RefusesAnotherNumberOfValues) {
  const LaplaceProblem problem({{0, 0, 0}, {1, 0, 0}}, {}, {0, 0, 0});
  EXPECT_THROW(Potential(problem, std::vector<double>(3, 0.0)), std::invalid_argument);
}

// Planes of a set against its cells, one by one.
TEST(LaplaceDomain, TakesTheBricksOfASet) {
  std::mt19937 engine(27);
  std::uniform_int_distribution<std::int32_t> at(-40, 40);
  BrickSet cells;
  BrickSet sinks;
  LaplaceDomain expected;
  for (int i = 0; i < 20000; ++i) {
    const VoxelIndex cell{at(engine), at(engine), at(engine)};
    cells.insert(cell);
    if (i % 7 == 0) {
      sinks.insert(cell);
      expected.insert_sink(cell);
    } else {
      expected.insert(cell);
    }
  }
  LaplaceDomain domain;
  cells.for_each_brick([&](const VoxelIndex& brick, const BrickPlane& plane) {
    const BrickPlane* const of_sinks = sinks.find(brick);
    domain.insert(brick, plane, of_sinks == nullptr ? BrickPlane{} : *of_sinks);
  });
  std::size_t count = 0;
  domain.for_each_cell([&](const VoxelIndex& cell) {
    ASSERT_TRUE(expected.contains(cell));
    ASSERT_EQ(domain.is_sink(cell), expected.is_sink(cell));
    ++count;
  });
  EXPECT_EQ(count, expected.cell_count());
  EXPECT_EQ(count, cells.size());
  EXPECT_EQ(domain.sink_count(), expected.sink_count());
  EXPECT_GE(count, 10000U);
}

}  // namespace
}  // namespace vantage
