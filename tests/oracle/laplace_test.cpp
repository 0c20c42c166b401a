// SPDX-License-Identifier: MIT
// The relaxation against a dense solution of the same equations, assembled independently.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vantage/field/laplace_relaxation.hpp>
#include <vantage/field/streamline.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

using Position = LaplaceProblem::Position;

// One row per cell, from the definitions: identity at sinks and source; elsewhere, per axis, the second difference,
// where the value behind a closed face is left out (FiniteVolume) or taken from the opposite side (Mirror, eq. 9).
Eigen::MatrixXd dense_operator(const LaplaceProblem& problem, NeumannScheme scheme) {
  const auto n = static_cast<Eigen::Index>(problem.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto position = static_cast<Position>(i);
    if (problem.kind(position) != LaplaceCell::Interior) {
      a(i, i) = 1.0;
      continue;
    }
    for (const std::size_t axis : {0U, 1U, 2U}) {
      const VoxelIndex step = kFaceNeighbours[2 * axis + 1];
      const auto below = problem.position_of(problem.cell(position) - step);
      const auto above = problem.position_of(problem.cell(position) + step);
      const double folded = scheme == NeumannScheme::Mirror && below.has_value() != above.has_value() ? 2.0 : 1.0;
      for (const auto& side : {below, above}) {
        if (side) {
          a(i, i) += folded;
          a(i, static_cast<Eigen::Index>(*side)) -= folded;
        }
      }
    }
  }
  return a;
}

Eigen::VectorXd dense_solution(const LaplaceProblem& problem, const RelaxationOptions& options) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.size()));
  const double interior = static_cast<double>(problem.size() - problem.sink_count() - 1);
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const LaplaceCell kind = problem.kind(static_cast<Position>(i));
    b(i) = kind == LaplaceCell::Source     ? 1.0
           : kind == LaplaceCell::Interior ? options.uniform_source / interior
                                           : 0.0;
  }
  return dense_operator(problem, options.neumann).fullPivLu().solve(b);
}

TEST(LaplaceOracle, RelaxationEqualsDenseLuForEveryScheme) {
  std::mt19937 engine(7);
  std::size_t cases = 0;
  std::size_t interior = 0;
  for (int world = 0; world < 300; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    for (const auto scheme : {NeumannScheme::FiniteVolume, NeumannScheme::Mirror}) {
      RelaxationOptions options;
      options.neumann = scheme;
      options.tolerance = 1e-15;
      options.uniform_source = world % 5 == 0 ? 0.01 : 0.0;
      const LaplaceSolution solution = relax_laplace(problem, options);
      const Eigen::VectorXd expected = dense_solution(problem, options);
      for (std::size_t i = 0; i < problem.size(); ++i) {
        ASSERT_NEAR(solution.phi[i], expected(static_cast<Eigen::Index>(i)), 1e-12) << "world " << world;
        interior += problem.kind(static_cast<Position>(i)) == LaplaceCell::Interior ? 1U : 0U;
      }
      ++cases;
    }
  }
  EXPECT_GE(cases, 400U);
  EXPECT_GE(interior, 10000U);
}

TEST(LaplaceOracle, FiniteVolumeIsSymmetricAndMirrorIsNot) {
  std::mt19937 engine(8);
  std::size_t symmetric = 0;
  std::size_t not_symmetric = 0;
  for (int world = 0; world < 100; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    std::vector<Eigen::Index> inner;
    for (std::size_t i = 0; i < problem.size(); ++i) {
      if (problem.kind(static_cast<Position>(i)) == LaplaceCell::Interior) {
        inner.push_back(static_cast<Eigen::Index>(i));
      }
    }
    const Eigen::MatrixXd finite_volume = dense_operator(problem, NeumannScheme::FiniteVolume)(inner, inner);
    const Eigen::MatrixXd mirror = dense_operator(problem, NeumannScheme::Mirror)(inner, inner);
    symmetric += (finite_volume - finite_volume.transpose()).norm() == 0.0 ? 1U : 0U;
    not_symmetric += (mirror - mirror.transpose()).norm() > 0.0 ? 1U : 0U;
  }
  EXPECT_EQ(symmetric, 100U);
  EXPECT_GE(not_symmetric, 80U);
}

// Reciprocity: in a symmetric operator, the flux from a to b equals that from b to a.
TEST(LaplaceOracle, SwappingSourceAndSinkKeepsTheFlux) {
  std::mt19937 engine(9);
  const RelaxationOptions options{.tolerance = 1e-14};
  std::size_t cases = 0;
  for (int world = 0; world < 150; ++world) {
    const RandomLaplace random(engine);
    const VoxelIndex sink = random.sinks.front();
    const LaplaceProblem there(random.cells, std::span(&sink, 1), random.source);
    if (there.sink_count() == 0) {
      continue;
    }
    const LaplaceProblem back(random.cells, std::span(&random.source, 1), sink);
    const LaplaceSolution a = relax_laplace(there, options);
    const LaplaceSolution b = relax_laplace(back, options);
    for (std::size_t i = 0; i < there.size(); ++i) {  // one value is 1 minus the other
      ASSERT_NEAR(a.phi[i], 1.0 - b.phi[i], 1e-10);
    }
    ++cases;
  }
  EXPECT_GE(cases, 80U);
}

TEST(LaplaceOracle, FluxIsConservedThroughEveryCutBetweenSourceAndSinks) {
  std::mt19937 engine(10);
  const RelaxationOptions options{.tolerance = 1e-14};
  std::size_t cuts = 0;
  for (int world = 0; world < 150; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const LaplaceSolution solution = relax_laplace(problem, options);
    // Cuts between the cells above and below a value of phi: the flux through all cuts is the same.
    const auto flux_across = [&](double level) {
      double flux = 0.0;
      for (std::size_t i = 0; i < problem.size(); ++i) {
        for (const Position neighbour : problem.neighbours(static_cast<Position>(i))) {
          const double here = solution.phi[i];
          if (neighbour != LaplaceProblem::kClosed && here > level) {
            const double there = solution.phi[static_cast<std::size_t>(neighbour)];
            flux += there > level ? 0.0 : here - there;
          }
        }
      }
      return flux;
    };
    const double out_of_source = flux_across(1.0 - 1e-9);
    for (const double level : {1e-9, 0.2, 0.5, 0.8}) {
      ASSERT_NEAR(flux_across(level), out_of_source, 1e-7) << "world " << world << " level " << level;
      ++cuts;
    }
  }
  EXPECT_GE(cuts, 300U);
}

TEST(LaplaceOracle, MaximumPrincipleHoldsAtEverySweep) {
  std::mt19937 engine(11);
  std::size_t sweeps = 0;
  for (int world = 0; world < 100; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    LaplaceRelaxation relaxation(problem);
    for (int i = 0; i < 20; ++i, ++sweeps) {
      relaxation.sweep();
      const auto [low, high] = std::minmax_element(relaxation.phi().begin(), relaxation.phi().end());
      ASSERT_GE(*low, 0.0);
      ASSERT_LE(*high, 1.0 + 1e-15);
    }
  }
  EXPECT_EQ(sweeps, 2000U);
}

// The purpose of the uniform source: in a nearly converged field, every cell has a strictly lower neighbour.
TEST(LaplaceOracle, UniformSourceLeavesNoCellStuck) {
  std::mt19937 engine(12);
  std::size_t cases = 0;
  std::size_t stuck_without = 0;
  for (int world = 0; world < 300; ++world) {
    const LaplaceProblem problem = RandomLaplace(engine).problem();
    if (problem.sink_count() == 0) {
      continue;
    }
    const LaplaceSolution plain = relax_laplace(problem, {.tolerance = 1e-12});
    stuck_without += count_stuck_cells(Potential(problem, plain.phi)) > 0 ? 1U : 0U;
    const LaplaceSolution certain = relax_laplace(problem, {.tolerance = 1e-12, .uniform_source = 1e-4});
    // Behind the source, away from the sinks, phi exceeds 1; the source itself is not an interior cell.
    const Potential potential(problem, certain.phi);
    ASSERT_EQ(count_stuck_cells(potential), 0U) << "world " << world;
    ASSERT_TRUE(descend(potential, potential.source()).reaches_sink);
    ++cases;
  }
  EXPECT_GE(cases, 200U);
  EXPECT_GE(stuck_without, 20U);
}

}  // namespace
}  // namespace vantage
