// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/field/streamline.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

TEST(Streamline, DescentFallsStrictlyThroughFacesAndEnds) {
  std::mt19937 engine(21);
  std::size_t arrived = 0;
  std::size_t stuck = 0;
  for (int world = 0; world < 300; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    // Descent must also end, and report where, after a few sweeps without convergence.
    const LaplaceSolution rough = relax_laplace(problem, {.max_sweeps = 2});
    const Potential potential(problem, rough.phi);
    const Descent descent = descend(potential, potential.source());
    ASSERT_EQ(descent.cells.front(), problem.cell(problem.source()));
    for (std::size_t i = 1; i < descent.cells.size(); ++i) {
      const VoxelIndex step = descent.cells[i] - descent.cells[i - 1];
      ASSERT_NE(std::find(kFaceNeighbours.begin(), kFaceNeighbours.end(), step), kFaceNeighbours.end());
      ASSERT_LT(*potential.at(descent.cells[i]), *potential.at(descent.cells[i - 1]));
    }
    ASSERT_EQ(descent.reaches_sink, problem.kind(*problem.position_of(descent.cells.back())) == LaplaceCell::Sink);
    (descent.reaches_sink ? arrived : stuck) += 1;
  }
  EXPECT_EQ(arrived + stuck, 300U);
  EXPECT_GE(arrived, 100U);
  EXPECT_GE(stuck, 5U);
}

TEST(Streamline, SmoothCurveStaysInTheDomainAndEndsInASink) {
  std::mt19937 engine(22);
  const VoxelFrame frame{0.2};
  std::size_t arrived = 0;
  std::size_t solvable = 0;
  for (int world = 0; world < 200; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine, 12).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    ++solvable;
    const LaplaceSolution solution = relax_laplace(problem, {.tolerance = 1e-10});
    const Eigen::Vector3d from = frame.centre_of(problem.cell(problem.source())) + Eigen::Vector3d(0.03, -0.05, 0.02);
    const auto curve = streamline(Potential(problem, solution.phi), frame, from);
    if (!curve) {
      continue;
    }
    ++arrived;
    ASSERT_EQ(curve->front(), from);
    for (const Eigen::Vector3d& point : *curve) {
      ASSERT_TRUE(problem.position_of(frame.cell_of(point)));
    }
    ASSERT_EQ(problem.kind(*problem.position_of(frame.cell_of(curve->back()))), LaplaceCell::Sink);
    for (std::size_t i = 1; i < curve->size(); ++i) {
      ASSERT_LE(((*curve)[i] - (*curve)[i - 1]).norm(), 0.1 + 1e-12);
    }
  }
  EXPECT_GE(solvable, 120U);
  EXPECT_GE(2 * arrived, solvable);
}

TEST(Streamline, InAnEmptyBoxItGoesNearlyStraightToTheSink) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {20, 20, 20}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  const VoxelIndex sink{16, 15, 14};
  const LaplaceProblem problem(cells, std::span(&sink, 1), {3, 4, 5});
  const LaplaceSolution solution = relax_laplace(problem, {.tolerance = 1e-8});
  const VoxelFrame frame{0.1};
  const auto curve = streamline(Potential(problem, solution.phi), frame, frame.centre_of({3, 4, 5}));
  ASSERT_TRUE(curve);
  double length = 0.0;
  for (std::size_t i = 1; i < curve->size(); ++i) {
    length += ((*curve)[i] - (*curve)[i - 1]).norm();
  }
  EXPECT_LT(length, 1.15 * (frame.centre_of(sink) - frame.centre_of({3, 4, 5})).norm());
}

TEST(Streamline, CountsCellsWithoutAWayDown) {
  std::vector<VoxelIndex> cells;
  for_each_cell({{0, 0, 0}, {5, 1, 1}}, [&](const VoxelIndex& cell) { cells.push_back(cell); });
  const VoxelIndex sink{4, 0, 0};
  const LaplaceProblem problem(cells, std::span(&sink, 1), {1, 0, 0});
  const std::vector<double> level{1.0, 1.0, 0.5, 0.5, 0.0};
  EXPECT_EQ(count_stuck_cells(Potential(problem, level)), 2U);  // the dead end behind the source, and the step
  EXPECT_EQ(count_stuck_cells(Potential(problem, std::vector<double>{2.0, 1.0, 0.5, 0.2, 0.0})), 0U);
}

}  // namespace
}  // namespace vantage
