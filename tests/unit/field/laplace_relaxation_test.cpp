// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vantage/field/laplace_relaxation.hpp>

namespace vantage {
namespace {

LaplaceProblem corridor(std::int32_t length) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {length, 1, 1}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  const VoxelIndex sink{length - 1, 0, 0};
  return LaplaceProblem(cells, std::span(&sink, 1), {0, 0, 0});
}

TEST(LaplaceRelaxation, FallsEvenlyAlongACorridor) {
  const LaplaceProblem problem = corridor(11);
  const LaplaceSolution solution = relax_laplace(problem, {.tolerance = 1e-14});
  EXPECT_EQ(solution.report.stop, LaplaceStop::Converged);
  EXPECT_LT(solution.report.last_change, 1e-14);
  EXPECT_EQ(solution.report.cell_updates, solution.report.sweeps * 9U);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_NEAR(solution.phi[i], 1.0 - static_cast<double>(i) / 10.0, 1e-12);
  }
}

// The 2D figure of the paper: a corner cell takes (2 left + 2 below) / 4, an edge cell (left + right + 2 below) / 4.
TEST(LaplaceRelaxation, MirrorIsEquationNine) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {3, 3, 1}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  const VoxelIndex sink{0, 0, 0};
  const LaplaceProblem problem(cells, std::span(&sink, 1), {2, 1, 0});
  const LaplaceSolution solution = relax_laplace(problem, {.neumann = NeumannScheme::Mirror, .tolerance = 1e-15});
  const auto phi = [&](std::int32_t x, std::int32_t y) {
    return solution.phi[static_cast<std::size_t>(*problem.position_of({x, y, 0}))];
  };
  EXPECT_NEAR(phi(2, 2), 0.25 * (2 * phi(1, 2) + 2 * phi(2, 1)), 1e-13);
  EXPECT_NEAR(phi(1, 2), 0.25 * (phi(0, 2) + phi(2, 2) + 2 * phi(1, 1)), 1e-13);
  EXPECT_NEAR(phi(1, 1), 0.25 * (phi(0, 1) + phi(2, 1) + phi(1, 0) + phi(1, 2)), 1e-13);
  EXPECT_GT(std::abs(phi(1, 2) - phi(1, 1)), 1e-3);  // so that the mirrored term has an effect
}

TEST(LaplaceRelaxation, StopsAtTheSweepLimitAndSaysSo) {
  const LaplaceSolution solution = relax_laplace(corridor(50), {.max_sweeps = 3});
  EXPECT_EQ(solution.report.stop, LaplaceStop::SweepLimit);
  EXPECT_EQ(solution.report.sweeps, 3U);
  EXPECT_EQ(to_string(solution.report.stop), "sweep limit");
}

TEST(LaplaceRelaxation, ChangeIsInfiniteWhilePhiLeavesZero) {
  const LaplaceProblem problem = corridor(6);
  LaplaceRelaxation relaxation(problem);
  EXPECT_TRUE(std::isinf(relaxation.sweep()));
}

TEST(LaplaceRelaxation, RefusesOptionsByName) {
  const LaplaceProblem problem = corridor(4);
  const auto message = [&](const RelaxationOptions& options) {
    try {
      LaplaceRelaxation relaxation(problem, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message({.tolerance = 0.0}).find("RelaxationOptions::tolerance"), std::string::npos);
  EXPECT_NE(message({.max_sweeps = 0}).find("RelaxationOptions::max_sweeps"), std::string::npos);
  EXPECT_NE(message({.uniform_source = -1.0}).find("RelaxationOptions::uniform_source"), std::string::npos);
}

}  // namespace
}  // namespace vantage
