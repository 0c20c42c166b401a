// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vantage/field/harmonic_field.hpp>
#include <vantage/field/streamline.hpp>

#include "random_laplace.hpp"

namespace vantage {
namespace {

LaplaceDomain domain_of(const RandomLaplace& random) {
  LaplaceDomain domain;
  for (const VoxelIndex& cell : random.cells) {
    domain.insert(cell);
  }
  for (const VoxelIndex& sink : random.sinks) {
    domain.insert_sink(sink);
  }
  return domain;
}

// Whether a relaxed field is followed is decided on the list of cells. Descent in the potential must agree.
TEST(HarmonicField, IsFollowedIfDescentFromTheSourceReachesASink) {
  std::mt19937 engine(31);
  std::size_t followed = 0;
  std::size_t stuck = 0;
  for (int world = 0; world < 400; ++world) {
    const RandomLaplace random(engine, 12);
    const HarmonicField field = HarmonicField::solve(domain_of(random), random.source,
                                                     {.solver = FieldSolver::GaussSeidel,
                                                      .max_sweeps = 1 + static_cast<std::size_t>(world) % 6,
                                                      .uniform_source = 0.0},
                                                     1);
    ASSERT_EQ(field.followed, descend(field.potential, random.source).reaches_sink) << "world " << world;
    (field.followed ? followed : stuck) += 1;
  }
  EXPECT_GE(followed, 100U);
  EXPECT_GE(stuck, 50U);
}

TEST(HarmonicField, LeadsFromThePositionThroughNeighboursToASink) {
  std::mt19937 engine(32);
  const VoxelFrame frame{0.2};
  std::size_t followed = 0;
  std::size_t smooth = 0;
  for (int world = 0; world < 200; ++world) {
    const RandomLaplace random(engine, 8);
    HarmonicField field =
        HarmonicField::solve(domain_of(random), random.source,
                             {.solver = world % 2 == 0 ? FieldSolver::Multigrid : FieldSolver::GaussSeidel}, 1);
    if (!field.followed || field.potential.domain().sink_count() == 0) {
      continue;
    }
    const Eigen::Vector3d position = frame.centre_of(random.source) + Eigen::Vector3d(0.03, -0.05, 0.02);
    const std::vector<VoxelIndex> cells = field.follow(frame, position);
    ASSERT_EQ(cells.front(), random.source);
    ASSERT_TRUE(field.potential.domain().is_sink(cells.back()));
    ASSERT_EQ(frame.cell_of(field.streamline.back()), cells.back());
    smooth += field.streamline.front() == position ? 1U : 0U;
    ++followed;
  }
  EXPECT_GE(followed, 100U);
  EXPECT_GE(smooth, 80U);
}

}  // namespace
}  // namespace vantage
