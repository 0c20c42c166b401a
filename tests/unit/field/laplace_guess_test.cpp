// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vantage/field/laplace_guess.hpp>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/field/streamline.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

// Two rooms of 16 cells an edge, a wall one cell thick between them with one small door; the sink in the far corner.
LaplaceProblem two_rooms() {
  std::vector<VoxelIndex> cells;
  for_each_cell({{-16, 0, 0}, {17, 16, 16}}, [&](const VoxelIndex& cell) {
    if (cell.x != 0 || (cell.y >= 12 && cell.y < 14 && cell.z >= 2 && cell.z < 4)) {
      cells.push_back(cell);
    }
  });
  const VoxelIndex sink{16, 0, 15};
  return LaplaceProblem(cells, std::span(&sink, 1), {-12, 3, 3});
}

TEST(LaplaceGuess, CarriesTheLevelOfARoomThroughItsDoor) {
  const LaplaceProblem problem = two_rooms();
  const LaplaceSolution exact = relax_laplace(problem, {.tolerance = 1e-9, .over_relaxation = 1.9});
  const std::vector<double> guess = coarse_to_fine_guess(problem);
  const LaplaceSolution short_run = relax_laplace(problem, {.max_sweeps = 200});
  double worst = 0.0;
  double worst_from_zero = 0.0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    worst = std::max(worst, std::abs(guess[i] - exact.phi[i]));
    worst_from_zero = std::max(worst_from_zero, std::abs(short_run.phi[i] - exact.phi[i]));
  }
  EXPECT_LT(worst, 0.1);
  EXPECT_GT(worst_from_zero, 2.0 * worst);  // 200 sweeps from zero are not worth one guess
  EXPECT_TRUE(descend(problem, guess, problem.source()).reaches_sink);
}

// On a problem small enough to be solved outright, the guess is the solution.
TEST(LaplaceGuess, IsExactWhereItIsSolvedOutright) {
  std::mt19937 engine(31);
  std::size_t cases = 0;
  for (int world = 0; world < 200; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const double uniform_source = world % 2 == 0 ? 0.0 : 1e-3;
    const std::vector<double> guess = coarse_to_fine_guess(problem, uniform_source);
    const LaplaceSolution exact = relax_laplace(problem, {.tolerance = 1e-14, .uniform_source = uniform_source});
    for (std::size_t i = 0; i < problem.size(); ++i) {
      ASSERT_NEAR(guess[i], exact.phi[i], 1e-10) << "world " << world;
    }
    ++cases;
  }
  EXPECT_GE(cases, 150U);
}

TEST(LaplaceGuess, KeepsTheMaximumPrincipleOnIrregularDomains) {
  std::mt19937 engine(32);
  std::size_t large = 0;
  for (int world = 0; world < 40; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine, 24).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const std::vector<double> guess = coarse_to_fine_guess(problem);
    const auto [low, high] = std::minmax_element(guess.begin(), guess.end());
    ASSERT_GE(*low, -1e-12);
    ASSERT_LE(*high, 1.0 + 1e-12);
    large += problem.size() > 800 ? 1U : 0U;
  }
  EXPECT_GE(large, 10U);
}

TEST(LaplaceGuess, NothingInsideMeansNothingToGuess) {
  const std::vector<VoxelIndex> cells{{0, 0, 0}, {1, 0, 0}};
  const VoxelIndex sink{1, 0, 0};
  const LaplaceProblem problem(cells, std::span(&sink, 1), {0, 0, 0});
  EXPECT_EQ(coarse_to_fine_guess(problem, 1e-4), (std::vector<double>{1.0, 0.0}));
}

}  // namespace
}  // namespace vantage
